/* modules.c - the table of slots, and the agreement of scene and binary. */
#include "modules.h"

#include <string.h>
#include "../contact/bond/bond.h"
#include "../contact/cohesion/cohesion.h"
#include "../contact/contact.h"
#include "../contact/lubrication/lubrication.h"
#include "../contact/rolling/rolling.h"
#include "../drag/drag.h"
#include "../forces/force.h"
#include "../porosity/porosity.h"
#include "../reference/reference.h"
#include "../shapes/shape.h"
#include "fluid/fluid.h"
#include "force_names.h"

const struct slot slots[SLOTS] = {
    {"shape", &shape_about, shape_keys},
    {"contact", &contact_about, contact_keys},
    {"rolling", &rolling_about, rolling_keys},
    {"bond", &bond_about, bond_keys},
    {"cohesion", &cohesion_about, cohesion_keys},
    {"lubrication", &lubrication_about, lubrication_keys},
    {"drag", &drag_about, drag_keys},
    {"porosity", &porosity_about, porosity_keys},
    {"fluid", &fluid_about, fluid_keys},
    {"reference", &reference_about, reference_keys},
};

/* The slots of a scene; the words are the names of files, which the front end checks. */
static const struct key modules_keys[] = {
    {"modules", "shape", KEY_TEXT, "", "", "sphere", "what is a grain?"},
    {"modules", "contact", KEY_TEXT, "", "", "none", "what force when two bodies touch?"},
    {"modules", "rolling", KEY_TEXT, "", "", "none", "what resists rolling?"},
    {"modules", "bond", KEY_TEXT, "", "", "none", "what holds glued grains together?"},
    {"modules", "cohesion", KEY_TEXT, "", "", "none", "what pulls when wet or sticky?"},
    {"modules", "lubrication", KEY_TEXT, "", "", "none",
     "what does the film between grains do?"},
    {"modules", "drag", KEY_TEXT, "", "", "none", "what resists the flow?"},
    {"modules", "porosity", KEY_TEXT, "", "", "none", "what does the grid see of a grain?"},
    {"modules", "fluid", KEY_TEXT, "", "", "none", "what flows?"},
    {"modules", "forces", KEY_TEXT, "", "", "standard",
     "what else does the fluid do to grains? as many of forces/ as wanted; standard, with a "
     "fluid: " FORCES_STANDARD "; -NAME takes one away, none all"},
    {"modules", "reference", KEY_TEXT, "", "", "none", "what should come out?"},
    {0},
};

char *forces_built(void)
{
    char *text = xstrdup("none");
    for (int f = 0; forces[f]; f++) {
        char *const longer = xprintf("%s %s", text, forces[f]->about.name);
        xfree(text);
        text = longer;
    }
    char *const out = force_names(text, false);
    xfree(text);
    return out;
}

static void declare_forces(struct scene *s)
{
    const bool fluid = strcmp(fluid_about.name, "none") != 0;
    char *const asked = force_names(scene_text(s, "modules", NULL, "forces"), fluid);
    char *const built = forces_built();
    if (strcmp(asked, built) != 0)
        scene_error(s, "modules", NULL, "forces",
                    "this binary was built with %s; ./run.sh builds what the scene asks for",
                    built);
    if (strcmp(built, "none") != 0 && !fluid)
        scene_error(s, "modules", NULL, "forces", "there is no fluid to exert them");
    for (int f = 0; forces[f]; f++)
        scene_declare(s, forces[f]->keys);
    xfree(asked);
    xfree(built);
}

void modules_declare(struct scene *s)
{
    scene_declare(s, modules_keys);
    for (int i = 0; i < SLOTS; i++) {
        const char *asked = scene_text(s, "modules", NULL, slots[i].name);
        if (strcmp(asked, slots[i].about->name) != 0)
            scene_error(
                s, "modules", NULL, slots[i].name,
                "this binary was built with %s; ./run.sh builds what the scene asks for",
                slots[i].about->name);
        scene_declare(s, slots[i].keys);
    }
    declare_forces(s);
}
