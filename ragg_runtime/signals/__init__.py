"""Signal processing without physics: FIR filters, derivatives, demodulation, spectra of noise."""
