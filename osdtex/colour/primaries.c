/* primaries.c -- RGB primaries as matrices to ACES2065-1, and back.
 *
 * The normalised primary matrix is that of [SMPTE RP 177]; the adaptation is
 * Bradford's [Lam85], as in the ACES configurations. */
#include "colour/primaries.h"

#include <math.h>

typedef otx_primaries_matrix matrix;

static const float aces_xy[8] = {
    0.7347F, 0.2653F, 0.0F, 1.0F, 0.0001F, -0.0770F, 0.32168F, 0.33767F};

/* XYZ to the cone responses in which white is adapted. */
static const matrix bradford = {
    {{0.8951, 0.2664, -0.1614},
     {-0.7502, 1.7135, 0.0367},
     {0.0389, -0.0685, 1.0296}}};

matrix
otx_primaries_multiply(matrix a, matrix b)
{
    matrix c;

    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            c.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] +
                        a.m[i][2] * b.m[2][j];
    return c;
}

double
otx_primaries_difference(matrix a, matrix b)
{
    double largest = 0.0;

    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            largest = fmax(largest, fabs(a.m[i][j] - b.m[i][j]));
    return largest;
}

/* By cofactors. */
bool
otx_primaries_invert(matrix a, matrix *out)
{
    matrix c;
    double det = 0.0;

    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
        {
            const int i1 = (i + 1) % 3;
            const int i2 = (i + 2) % 3;
            const int j1 = (j + 1) % 3;
            const int j2 = (j + 2) % 3;

            c.m[j][i] = a.m[i1][j1] * a.m[i2][j2] - a.m[i1][j2] * a.m[i2][j1];
        }
    for (int j = 0; j < 3; ++j)
        det += a.m[0][j] * c.m[j][0];
    if (!(fabs(det) > 1e-9))
        return false;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            out->m[i][j] = c.m[i][j] / det;
    return true;
}

static void
transform(const matrix *a, const double v[3], double out[3])
{
    for (int i = 0; i < 3; ++i)
        out[i] = a->m[i][0] * v[0] + a->m[i][1] * v[1] + a->m[i][2] * v[2];
}

static matrix
scale_columns(matrix a, const double s[3])
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            a.m[i][j] *= s[j];
    return a;
}

/* XYZ of chromaticity (x, y) at Y = 1. */
static bool
xyz_of_white(const float xy[2], double xyz[3])
{
    if (!(fabsf(xy[1]) > 1e-6F))
        return false;
    xyz[0] = (double)xy[0] / (double)xy[1];
    xyz[1] = 1.0;
    xyz[2] = (1.0 - (double)xy[0] - (double)xy[1]) / (double)xy[1];
    return true;
}

/* RGB to XYZ: the columns are the primaries, scaled so that they add up to
 * white. */
static bool
to_xyz(const float xy[8], matrix *out)
{
    matrix p;
    matrix inverse;
    double white[3];
    double scale[3];

    for (int j = 0; j < 3; ++j)
    {
        p.m[0][j] = (double)xy[2 * j];
        p.m[1][j] = (double)xy[2 * j + 1];
        p.m[2][j] = 1.0 - p.m[0][j] - p.m[1][j];
    }
    if (!xyz_of_white(xy + 6, white) || !otx_primaries_invert(p, &inverse))
        return false;
    transform(&inverse, white, scale);
    *out = scale_columns(p, scale);
    return true;
}

/* XYZ under one white to XYZ under another. */
static bool
adapt(const float from[2], const float to[2], matrix *out)
{
    double white[3];
    double from_cone[3];
    double to_cone[3];
    double ratio[3];
    matrix inverse;

    if (!xyz_of_white(from, white))
        return false;
    transform(&bradford, white, from_cone);
    if (!xyz_of_white(to, white) || !otx_primaries_invert(bradford, &inverse))
        return false;
    transform(&bradford, white, to_cone);
    for (int i = 0; i < 3; ++i)
    {
        if (!(from_cone[i] > 0.0))
            return false;
        ratio[i] = to_cone[i] / from_cone[i];
    }
    *out = otx_primaries_multiply(scale_columns(inverse, ratio), bradford);
    return true;
}

bool
otx_primaries_to_aces(const float xy[8], matrix *to_aces)
{
    matrix rgb_to_xyz;
    matrix aces_to_xyz;
    matrix xyz_to_aces;
    matrix adaptation;

    if (!to_xyz(xy, &rgb_to_xyz) || !to_xyz(aces_xy, &aces_to_xyz) ||
        !otx_primaries_invert(aces_to_xyz, &xyz_to_aces) ||
        !adapt(xy + 6, aces_xy + 6, &adaptation))
        return false;
    *to_aces = otx_primaries_multiply(
        xyz_to_aces, otx_primaries_multiply(adaptation, rgb_to_xyz));
    return true;
}

bool
otx_primaries_xyz_to_aces(matrix *to_aces)
{
    /* Of the profile connection space [ICC.1, 7.2.16]: X, Z at Y = 1. */
    const double white[3] = {0.9642, 1.0, 0.8249};
    const double sum = white[0] + white[1] + white[2];
    const float d50[2] = {(float)(white[0] / sum), (float)(white[1] / sum)};
    matrix aces_to_xyz;
    matrix xyz_to_aces;
    matrix adaptation;

    if (!to_xyz(aces_xy, &aces_to_xyz) ||
        !otx_primaries_invert(aces_to_xyz, &xyz_to_aces) ||
        !adapt(d50, aces_xy + 6, &adaptation))
        return false;
    *to_aces = otx_primaries_multiply(xyz_to_aces, adaptation);
    return true;
}

bool
otx_primaries_from_aces(const matrix *to_aces, float xy[8])
{
    matrix xyz;

    if (!to_xyz(aces_xy, &xyz))
        return false;
    xyz = otx_primaries_multiply(xyz, *to_aces);
    for (int j = 0; j < 4; ++j)
    {
        double c[3];

        for (int i = 0; i < 3; ++i)
            c[i] =
                j < 3 ? xyz.m[i][j] : xyz.m[i][0] + xyz.m[i][1] + xyz.m[i][2];
        const double sum = c[0] + c[1] + c[2];
        if (!(sum > 1e-9))
            return false;
        xy[2 * j] = (float)(c[0] / sum);
        xy[2 * j + 1] = (float)(c[1] / sum);
    }
    return true;
}
