"""Homework: tasks from scenes, answers checked in any equivalent form, mistakes found by making them again."""
