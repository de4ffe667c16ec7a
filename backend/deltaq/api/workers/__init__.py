"""Work in processes that can be killed: a supervisor that no job, however bad, can bring down."""
