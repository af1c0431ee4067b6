"""Ways that nobody drew: found for a robot in a task, among shapes that people would take, or by sampling."""
