"""From points to the mean of a pixel: the plan, the one integration loop, rendering and estimates."""
