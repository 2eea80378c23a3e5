"""From points to the mean of a pixel: the scene, the estimator, the plan, the renderer."""
