"""The commands, a file each; their imports are inside their bodies."""
