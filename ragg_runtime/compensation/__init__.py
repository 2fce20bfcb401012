"""What is done with a calibrated model: kept, taken out of the gravity gradient (whole or by samples), or exported."""
