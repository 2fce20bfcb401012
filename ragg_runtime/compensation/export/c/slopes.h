/* Derivatives by time, run by run of samples without a gap; the steps and their order are those of Python. */
#ifndef RAGG_SLOPES_H
#define RAGG_SLOPES_H

#include <stddef.h>

/* Of a series; runs shorter than a window have none (nan). */
void ragg_differentiate(size_t n, double step, const double *time, const double *x, double *slope);

/* Of an angular rate: amid a run by a longer window, good to 90 % of the Nyquist frequency. */
void ragg_acceleration(size_t n, double step, const double *time, const double *x, double *slope);

/* Rate (order 1) or acceleration (2) of an encoder's angle, rad, smoothed by polynomials of the fifth degree. */
void ragg_spin(size_t n, double step, const double *time, const double *angle, int order, double *slope);

#endif
