"""Motion computed: problems, methods, trajectories with their error estimate, status and cost."""
