/* Calibrate and compensate sample by sample, without allocation: a square-root information filter.
 *
 * A filter is of one output. States: the gradient's channels inline and cross, which wander, and the fitted parameters of its
 * accelerometers. Memory: one ragg_online. */
#ifndef RAGG_ONLINE_H
#define RAGG_ONLINE_H

#include "online_values.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { RAGG_ONLINE_STATES = FITTED_PARAMETERS + 2, RAGG_ONLINE_WIDTH = RAGG_ONLINE_STATES + 1 };

typedef struct {
    double U[RAGG_ONLINE_STATES][RAGG_ONLINE_WIDTH]; /* upper triangle, ones on its diagonal, and the right-hand side */
    double D[RAGG_ONLINE_STATES];                    /* the information is U^T D U; first the gradient's, inline and cross */
    double noise, walk, forget;
    double before, waited, faded;
    int begun, output;
} ragg_online;

/* What is known of the gradient: channels and their standard deviations, Eo. */
typedef struct {
    double inline_Eo, cross_Eo, inline_std, cross_std;
} ragg_gradient;

/* Begin at the calibration that is built in. output: 0 ... ONLINE_OUTPUTS - 1 (see ONLINE_OUTPUT). noise: standard deviation of a
 * sample of G_out, V. walk: of the cross channel, Eo/sqrt(s), inline twice as much; 0 if they are constant. forget: time constant,
 * s, with which parameters forget; INFINITY: never. */
void ragg_online_start(ragg_online *o, int output, double noise, double walk, double forget);

/* Take a sample: t, s, since the first; in, the model's inputs (gradients zero); angle of the disc, rad, or NaN for
 * 2 pi spin_frequency t; G, the output, V. What is not a number is passed over; gaps may be of any length. Returns 1 where the
 * gradient has just taken a step of its walk. */
int ragg_online_step(ragg_online *o, double t, const double in[ONLINE_INPUTS], double angle, double G);

/* The gradient, whatever the parameters may be. */
ragg_gradient ragg_online_gradient(const ragg_online *o);

/* All parameters of the model, SI, as they are known by now. */
void ragg_online_parameters(const ragg_online *o, double p[ONLINE_PARAMETERS]);

#ifdef __cplusplus
}
#endif

#endif
