"""A study of one's own scene, told by a file."""
