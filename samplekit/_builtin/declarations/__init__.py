"""What comes with samplekit, declared without importing it: a file for each kind."""
