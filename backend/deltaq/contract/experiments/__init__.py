"""What may be asked of an experiment, one file each; what has no file is asked for no more than scene and span."""
