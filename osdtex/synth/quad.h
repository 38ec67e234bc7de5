/* quad.h -- four floats that go through arithmetic together.
 *
 * The compiler's vector type, so that there is one source for all machines.
 * Sums over the four are made in one order. */
#ifndef OTX_SYNTH_QUAD_H
#define OTX_SYNTH_QUAD_H

typedef float otx_quad __attribute__((vector_size(16)));

static inline float
otx_quad_sum(otx_quad q)
{
    return (q[0] + q[1]) + (q[2] + q[3]);
}

#endif
