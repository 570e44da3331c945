/* The paper's method, for these contacts alone: the midpoint rule on N segments (ET = 1) and its
   extrapolation (ET = 2), by the formula with the sign corrected; limits such that P = 0 one segment
   inside, its Eq. (6) with A = B = 0. The limits are adjusted by Broyden's method, which takes fewer
   trials than the paper's one limit at a time. The 101 points lie where segments meet. */
#include <stdlib.h>
#include "tasks.h"

static int segments, extrapolations;
static double *weighed[2]; /* sqrt(1 - t^2) g at the midpoints of N and of 2N segments */

static void sample(task *t, double centre, double half) {
    for (int level = 0; level < extrapolations; level++) {
        int n = segments << level;
        for (int i = 0; i < n; i++) {
            double z = (2.0 * i + 1 - n) / n;
            weighed[level][i] = sqrt((1 - z) * (1 + z)) * slope(t, centre + half * z);
        }
    }
}

/* PV int sqrt(1 - t^2) g/(z - t) dt. */
static double integral(double z) {
    double sum[2] = {0, 0};
    for (int level = 0; level < extrapolations; level++) {
        int n = segments << level;
        for (int i = 0; i < n; i++) sum[level] += weighed[level][i] / (z - (2.0 * i + 1 - n) / n);
        sum[level] *= 2.0 / n;
    }
    return extrapolations == 2 ? (4 * sum[1] - sum[0]) / 3 : sum[0];
}

/* P at the two places, as shares of C. */
static void excess(task *t, const double u[2], double half_0, double out[2]) {
    double half = half_0 * exp(u[1]), z = 1 - 2.0 / segments;
    sample(t, half_0 * u[0], half);
    for (int side = 0; side < 2; side++)
        out[side] = 1 - t->kappa * half * integral(side ? z : -z) / t->c;
}

static int solve(task *t, double *limits, double *p) {
    double half_0 = 0.5 * (t->right - t->left), u[2] = {(t->left + t->right) / (2 * half_0), 0};
    double f[2], g[2], j[2][2], step = 1e-4;
    excess(t, u, half_0, f);
    for (int i = 0; i < 2; i++) {
        double v[2] = {u[0], u[1]};
        v[i] += step;
        excess(t, v, half_0, g);
        for (int r = 0; r < 2; r++) j[r][i] = (g[r] - f[r]) / step;
    }
    for (int trial = 0; fabs(f[0]) + fabs(f[1]) > 1e-12; trial++) {
        double det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
        double d[2] = {-(f[0] * j[1][1] - f[1] * j[0][1]) / det, -(f[1] * j[0][0] - f[0] * j[1][0]) / det};
        double square = d[0] * d[0] + d[1] * d[1];
        if (trial == 50 || !(square < 100)) return 1;
        for (int i = 0; i < 2; i++) u[i] += d[i];
        excess(t, u, half_0, f);
        for (int r = 0; r < 2; r++) for (int i = 0; i < 2; i++) j[r][i] += f[r] * d[i] / square;
        if (square < 1e-28) break;
    }
    double centre = half_0 * u[0], half = half_0 * exp(u[1]);
    for (int i = 0; i < 101; i++) {
        double z = 2.0 * (i + 1) / 102 - 1;
        p[i] = (t->c - t->kappa * half * integral(z)) / (M_PI * M_PI * half * sqrt((1 - z) * (1 + z)));
    }
    limits[0] = centre - half;
    limits[1] = centre + half;
    return 0;
}

int main(void) {
    const int most = 102 * 1024;
    for (int level = 0; level < 2; level++) weighed[level] = malloc(sizeof(double) * (most << level));
    for (int i = 0; i < 4; i++)
        for (extrapolations = 1; extrapolations <= 2; extrapolations++)
            for (segments = 102; segments <= most; segments *= 4) {
                char name[32], setting[32];
                sprintf(name, "paper in C, ET=%d", extrapolations);
                sprintf(setting, "N=%d", segments);
                report(name, &tasks[i], setting, solve);
            }
}
