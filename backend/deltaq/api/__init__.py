"""The service: HTTP in front, killable workers behind. It knows everything; nothing knows it."""
