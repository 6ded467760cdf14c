/* reference/none.c - nothing to compare with. Also the template for new references. */
#include "reference.h"

const struct about reference_about = {
    .name = "none", .summary = "no reference", .equation = "", .source = "", .range = "always"};
const struct key reference_keys[] = {{0}};

void reference_create(struct sim *s, struct scene *scene)
{
    (void)s;
    (void)scene;
}

void reference_watch(struct sim *s)
{
    (void)s;
}

void reference_report(struct sim *s)
{
    (void)s;
}

void reference_free(struct sim *s)
{
    (void)s;
}
