/* The four contacts for the C programs: curves, the slope of the gap, and how a result is printed. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

typedef struct { double x, dx, dy; } point;
typedef struct { double end, k[2]; point (*curve)(double); double last; } piece; /* up to x = end */
typedef struct {
    const char *name;
    double kappa, c, left, right; /* limits that are off by a quarter, to start from */
    int count[2];
    piece body[2][2];
} task;

static long calls; /* evaluations of curves */

static point lower2(double k) { return (point){2 * k + 0.2, 2, -72 * k}; }
static point upper2(double k) { return (point){3 * k + 0.2, 3, 126 * k}; }

/* s, c, d: sin k, cos k and cos k - 1, without cancellation. */
#define CURVE(name, X, DX, DY) static point name(double k) { \
    double h = sin(0.5 * k), s = 2 * h * cos(0.5 * k), d = -2 * h * h, c = 1 + d; (void)c; (void)s; (void)d; \
    return (point){X, DX, DY}; }
CURVE(lower3, 2*d - 8*k*c - 9*s + 7*k*s, -17*c + 5*s + 8*k*s + 7*k*c, 1e5*(15*k*s - 15*s - 6*k*c))
CURVE(upper3, 7*s - 8*d + 3*k*c - 9*k*s, 10*c - s - 3*k*s - 9*k*c, 1e5*(40*s - 35*k*s + 10*k*c))
CURVE(circle, s, c, s)
CURVE(left4, 12*d - 2*s - 3*k*c + 2*k*s, 3*k*s + 2*k*c - 5*c - 10*s, 1e4*(63*k*s - 1494*s - 783*k*c))
CURVE(right4, 6*d - 5*s - 3*k*c + 9*k*s, 3*s - 8*c + 3*k*s + 9*k*c, 1e4*(7*s - 63*k*c - 112000*k + 35*k*k*s))
CURVE(upper4, 3*s + 2*k*c - k*s, 5*c - 2*k*s - s - k*c, 1e4*(1800*s - 27*k*s))

#define ALL INFINITY
static task tasks[] = {
    {"T2", M_PI / 2, 128 * M_PI * M_PI / 25, -0.7, 1.2, {1, 1},
     {{{ALL, {-2, 2}, lower2, 0}}, {{ALL, {-2, 2}, upper2, 0}}}},
    {"T3a", 1, 300, -0.07, 0.07, {1, 1},
     {{{ALL, {-1.3539997025528523, 0.7911938540783813}, lower3, 0}},
      {{ALL, {-1.428061671618955, 0.7623463067015128}, upper3, 0}}}},
    {"T4", 1, 2 * (1.685750354812596 - 1.4674622093394272), -0.6, 0.6, {0, 1},
     {{{0}}, {{ALL, {-1.5, 1.5}, circle, 0}}}},
    {"T5", 1, 20, -0.0037, 0.0008, {2, 1},
     {{{0, {0, 5.540299783323928}, left4, 0}, {ALL, {-1.5010288405450835, 0}, right4, 0}},
      {{ALL, {-1.317538157404613, 0.9495704265766943}, upper4, 0}}}},
};

/* The slope of one body, by Newton's method from the k found last. */
static double slope_of(task *t, int body, double x) {
    piece *p = t->body[body];
    if (!t->count[body]) return 0;
    while (x > p->end) p++;
    double k = p->last;
    for (int i = 0; i < 60; i++) {
        point at = p->curve(k);
        calls++;
        double step = (x - at.x) / at.dx, next = fmin(fmax(k + step, p->k[0]), p->k[1]);
        /* The slope changes by less than the square of such a step. */
        if (fabs(step) < 1e-15 + 1e-14 * fabs(k)) { p->last = next; return at.dy / at.dx; }
        k = next;
    }
    return NAN;
}

static double slope(task *t, double x) { return slope_of(t, 1, x) - slope_of(t, 0, x); }

/* Runs solve, which sets the limits and the pressures at 101 equidistant points, up to three times:
   the least time counts. */
static void report(const char *name, task *t, const char *setting, int (*solve)(task *, double *, double *)) {
    double limits[2], p[101], least = INFINITY;
    for (int run = 0; run < 3; run++) {
        struct timespec from, to;
        calls = 0;
        for (int b = 0; b < 2; b++) for (int i = 0; i < t->count[b]; i++) t->body[b][i].last = 0;
        clock_gettime(CLOCK_MONOTONIC, &from);
        if (solve(t, limits, p)) { fprintf(stderr, "%s %s %s: no result\n", name, t->name, setting); return; }
        clock_gettime(CLOCK_MONOTONIC, &to);
        double took = (to.tv_sec - from.tv_sec) * 1e6 + (to.tv_nsec - from.tv_nsec) * 1e-3;
        least = fmin(least, took);
        if (took > 5e5) break;
    }
    printf("%s\t%s\t%s\t%.17g\t%.17g\t%ld\t%.2f\t", name, t->name, setting, limits[0], limits[1], calls, least);
    for (int i = 0; i < 101; i++) printf("%.17g%c", p[i], i < 100 ? ' ' : '\n');
    fflush(stdout);
}
