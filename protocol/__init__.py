"""What crosses the wire: messages, topics, queries, codec, key expressions, quality of service."""
