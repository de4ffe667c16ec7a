"""Where answers are kept: in memory, on disk, and shared by replicas."""
