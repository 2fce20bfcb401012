"""Quality control of surveys in the industry's terms: noise by line, crossovers, dependences, steps from day to day."""
