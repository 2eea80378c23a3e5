"""The randomizers that come with samplekit, apart from the sequences that they randomise."""
