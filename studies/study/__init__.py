"""What the studies share: cases and their runs, tables, figures, pages."""
