/* sim.h - the state of a run: one struct of structs. Whatever changes in time is in here and in
 * the field table; modules keep only parameters. */
#ifndef SIM_H
#define SIM_H

#include <signal.h>
#include "analysis.h"
#include "body.h"
#include "coupling.h"
#include "domain.h"
#include "flow.h"
#include "fluid/fluid.h"
#include "grains.h"
#include "insert.h"
#include "ledger.h"
#include "materials.h"
#include "neighbours.h"
#include "table.h"
#include "timers.h"
#include "walls.h"

struct probes;       /* what is measured of the fluid */
struct contact_work; /* scratch of the contact loop */
struct attitude;

enum save_bed { SAVE_NONE, SAVE_START, SAVE_END };

struct run {
    double end;           /* s */
    double dt;            /* s, grains' step */
    int substeps;         /* grain steps per fluid step (dry: per call of step) */
    int record;           /* dry: most of them; fewer before an output */
    double settle_time;   /* s, longest settling before t = 0 */
    double settle_energy; /* kinetic energy per m g d of a grain at which a bed has settled */
    double overlap_max;   /* of the radius; more stops the run */
    double speed;         /* m/s, highest expected; 0: estimated */
    bool force;           /* run in spite of broken limits */
    unsigned long seed;
    char *directory;                   /* of the outputs */
    double output_every;               /* s, fields and grains; INFINITY: first and last only */
    double series_every;               /* s */
    bool series_asked;                 /* by the scene: samples are taken at just these times */
    enum save_bed save_bed;            /* when bed.nc is written */
    bool done;                         /* what the run was for has been found: it ends */
    const volatile sig_atomic_t *stop; /* not zero: a signal asks the run to end; or NULL */
};

struct sim {
    double t;   /* s; settling is before 0 */
    long step;  /* calls of step() */
    long clock; /* steps of length run.dt since t = 0 */
    struct run run;
    struct domain domain;
    struct grains grains;
    struct traffic traffic;
    struct frame frame;
    struct body *bodies;        /* per grain, as the contact loop reads it */
    struct body_rest *rests;    /* what the motion knows beyond */
    struct attitude *attitudes; /* per grain, likewise; NULL: the path asks for none */
    struct neighbours neighbours;
    struct walls walls;
    struct contact_work *contacts;
    struct grid grid;
    struct fluid fluid;
    struct flow flow;
    struct coupling coupling;
    struct ledger ledger;
    struct timers timers;
    struct analysis analysis;
    struct fields fields;
    struct series series;
    struct tables tables;
    struct summary summary;
    long substep;       /* grain steps since the start, settling included */
    double grain_steps; /* the same times the grains that there were */
    bool loaded;        /* some grain bears a load, see motion_sense_loads */
    double overlap;     /* largest overlap over the smaller radius at the last step */
    double elastic;     /* J in the springs of the contacts, when last asked for */
    struct probes *probes;
    void *reference; /* state of the reference answer */
};

struct feasibility;

struct sim *sim_alloc(void);
/* Everything from the scene but the outputs; errors go on the scene's list. Fills the
 * feasibility report if the scene is sound. */
void sim_create(struct sim *s, struct scene *scene, struct feasibility *f);
void sim_start(struct sim *s); /* forces of the contacts that exist at the start */
void sim_free(struct sim *s);

#endif
