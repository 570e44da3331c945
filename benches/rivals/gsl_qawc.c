/* GSL, by the formulas of scipy_qawc.py: QAGS and QAWC in t, x = c + L cos t, split where pieces join;
   hybrids for the limits, Newton for X(k) = x. Settings: the tolerance of all integrals and limits. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_multiroots.h>
#include <gsl/gsl_vector.h>
#include "tasks.h"

static double tolerance;
static gsl_integration_workspace *space;
typedef struct { task *t; double centre, half, half_0, pole; } scene;

static double mean(double t, void *with) { scene *s = with; return slope(s->t, s->centre + s->half * cos(t)); }
static double first(double t, void *with) { return cos(t) * mean(t, with); }
static double regular(double t, void *with) { /* all but 1/(t - pole) */
    scene *s = with;
    double d = 0.5 * (t - s->pole), sine = sin(t);
    return sine * sine * mean(t, with) * (d ? d / sin(d) : 1) / sin(d + s->pole);
}
static double whole(double t, void *with) { return regular(t, with) / (t - ((scene *)with)->pole); }

/* An integral from 0 to pi of the function, or PV of regular/(t - pole) if there is none. */
static double integral(double (*f)(double, void *), scene *s, double absolute) {
    double ends[3] = {0, M_PI, M_PI}, sum = 0, part, error;
    int parts = 1;
    if (s->t->count[0] == 2 && fabs(s->centre) < s->half) { /* the joint of T5, at 0 */
        ends[1] = acos(-s->centre / s->half);
        parts = 2;
    }
    for (int i = 0; i < parts; i++) {
        gsl_function g = {f, s};
        if (f) {
            gsl_integration_qags(&g, ends[i], ends[i + 1], absolute, tolerance, 200, space, &part, &error);
        } else if (ends[i] < s->pole && s->pole < ends[i + 1]) {
            g.function = regular;
            gsl_integration_qawc(&g, ends[i], ends[i + 1], s->pole, 0, tolerance, 200, space, &part, &error);
        } else {
            g.function = whole;
            gsl_integration_qags(&g, ends[i], ends[i + 1], 0, tolerance, 200, space, &part, &error);
        }
        sum += part;
    }
    return sum;
}

static int excess(const gsl_vector *u, void *with, gsl_vector *out) {
    scene *s = with;
    s->centre = s->half_0 * gsl_vector_get(u, 0);
    s->half = s->half_0 * exp(gsl_vector_get(u, 1));
    double size = s->t->c / (s->t->kappa * s->half);
    gsl_vector_set(out, 0, integral(mean, s, 0.1 * tolerance * size) / size);
    gsl_vector_set(out, 1, integral(first, s, 0.1 * tolerance * size) / size - 1);
    return GSL_SUCCESS;
}

static int solve(task *t, double *limits, double *p) {
    scene s = {.t = t, .half_0 = 0.5 * (t->right - t->left)};
    gsl_multiroot_function f = {excess, 2, &s};
    gsl_multiroot_fsolver *solver = gsl_multiroot_fsolver_alloc(gsl_multiroot_fsolver_hybrids, 2);
    gsl_vector *u = gsl_vector_calloc(2);
    gsl_vector_set(u, 0, (t->left + t->right) / (2 * s.half_0));
    gsl_multiroot_fsolver_set(solver, &f, u);
    for (int i = 0; i < 50; i++) {
        if (gsl_multiroot_fsolver_iterate(solver)) break; /* no progress: it is at rounding */
        if (gsl_multiroot_test_delta(solver->dx, solver->x, 0.1 * tolerance, 0) == GSL_SUCCESS) break;
    }
    s.centre = s.half_0 * gsl_vector_get(solver->x, 0);
    s.half = s.half_0 * exp(gsl_vector_get(solver->x, 1));
    gsl_multiroot_fsolver_free(solver);
    gsl_vector_free(u);
    for (int i = 0; i < 101; i++) {
        s.pole = acos(2.0 * (i + 1) / 102 - 1);
        p[i] = (t->c / s.half - t->kappa * integral(NULL, &s, 0)) / (M_PI * M_PI * sin(s.pole));
    }
    limits[0] = s.centre - s.half;
    limits[1] = s.centre + s.half;
    return 0;
}

int main(void) {
    gsl_set_error_handler_off(); /* the judge sees what it would say */
    space = gsl_integration_workspace_alloc(200);
    for (int i = 0; i < 4; i++)
        for (int digits = 3; digits <= 12; digits += 3) {
            char setting[32];
            tolerance = pow(10, -digits);
            sprintf(setting, "tol=1e-%02d", digits);
            report("GSL QAWC", &tasks[i], setting, solve);
        }
}
