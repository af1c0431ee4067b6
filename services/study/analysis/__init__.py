"""What a study found: statistics, figures and the report, from the study's own data or from anybody's table."""
