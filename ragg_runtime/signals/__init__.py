"""Signal processing without physics: FIR filters, derivatives, demodulation, spectra of noise. May import base."""
