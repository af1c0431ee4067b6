"""Pictures as H.264: an option, by PyAV."""
