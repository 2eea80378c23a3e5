"""What sampler authors build on: sampler, realisations, hashing, permutations, strata, radical inverses, nets."""
