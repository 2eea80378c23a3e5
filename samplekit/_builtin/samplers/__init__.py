"""The samplers that come with samplekit: a file a family."""
