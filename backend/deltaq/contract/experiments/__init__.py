"""What each experiment is asked and what it finds, one file each."""
