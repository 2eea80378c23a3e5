"""What sampler authors build on: the sampler, realisations, hashing, permutations, strata, radical inverses, digital nets."""
