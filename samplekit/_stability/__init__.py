"""Whether estimates are right where scenes are stiff and requests extreme; and where not, why."""
