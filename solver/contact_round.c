/* contact_round.c - contacts of grains that may all be spheres: then by the loop of spheres, to its
 * last bit and at its speed; else by that of clumps (contact_members.c). */
#include "contact_path.h"
#include "sim.h"
#include "turning.h"

static const struct contact_path *path_of(const struct sim *s)
{
    for (int k = 0; k < s->grains.n_species; k++)
        if (s->grains.species[k].form.bounding > 1.0)
            return &contact_members;
    return &contact_spheres;
}

static void create(struct sim *s)
{
    if (path_of(s)->create)
        path_of(s)->create(s);
}

static void release(struct sim *s)
{
    if (path_of(s)->free)
        path_of(s)->free(s);
}

static void prepare(struct sim *s)
{
    if (path_of(s)->prepare)
        path_of(s)->prepare(s);
}

static int rows(const struct sim *s)
{
    return path_of(s)->rows(s);
}

static void pairs(struct sim *s, struct block *b, const int *slot, int count,
                  const struct target *to)
{
    path_of(s)->pairs(s, b, slot, count, to);
}

static void walls(struct sim *s, int run, struct block *b, const struct target *to)
{
    path_of(s)->walls(s, run, b, to);
}

static void view(const struct sim *s, struct contact_view *v)
{
    path_of(s)->view(s, v);
}

static size_t seen_size(const struct sim *s)
{
    return path_of(s)->seen_size(s);
}

static void stop(const struct sim *s)
{
    path_of(s)->stop(s);
}

static void take(struct sim *s, int run)
{
    if (path_of(s)->take)
        path_of(s)->take(s, run);
}

static void put_back(struct sim *s, int run)
{
    if (path_of(s)->put_back)
        path_of(s)->put_back(s, run);
}

static bool turns(const struct sim *s)
{
    return path_of(s)->turns && path_of(s)->turns(s);
}

const struct contact_path contact_round = {.create = create,
                                           .free = release,
                                           .prepare = prepare,
                                           .rows = rows,
                                           .pairs = pairs,
                                           .walls = walls,
                                           .view = view,
                                           .seen_size = seen_size,
                                           .stop = stop,
                                           .take = take,
                                           .put_back = put_back,
                                           .turning = &turning,
                                           .turns = turns};
