"""What servers of models have in common, whatever the models do: addresses, keys, refusals."""
