"""Comparison and diagnosis: the error of a model, what it lacks, and which flight would tell. May import
evidence, lack_of_fit and below.
"""
