"""Error against samples and run time: jobs, what they give, statistics, answers, and the files of a study."""
