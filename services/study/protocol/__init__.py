"""What a study is going to do, written down before it begins."""
