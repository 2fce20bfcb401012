"""Which physical effect a model lacks: the steps of the diagnosis."""
