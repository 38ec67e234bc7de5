/* saved_constraints.c -- constraints as JSON. */
#include "api/saved_constraints.h"

static json_t *
print_vector(otx_vec3 v)
{
    return json_pack("[f,f,f]", v.x, v.y, v.z);
}

/* Only what it says. */
static json_t *
print_item(const otx_constraint *c)
{
    json_t *item = json_object();

    if (c->face >= 0)
        json_object_set_new(item, "face", json_integer(c->face));
    else
    {
        json_object_set_new(item, "point", print_vector(c->point));
        json_object_set_new(item, "radius", json_real(c->radius));
    }
    if (c->has_direction)
        json_object_set_new(item, "direction", print_vector(c->direction));
    if (c->scale > 0.0)
        json_object_set_new(item, "scale", json_real(c->scale));
    if (c->has_material)
        json_object_set_new(item, "material", json_real(c->material));
    if (c->exemplar > 0)
        json_object_set_new(item, "exemplar", json_integer(c->exemplar));
    if (c->edit > 0)
        json_object_set_new(item, "edit", json_integer(c->edit));
    if (c->redo > 0)
        json_object_set_new(item, "redo", json_integer(c->redo));
    if (c->reach > 0.0)
        json_object_set_new(item, "reach", json_real(c->reach));
    return item;
}

static json_t *
print_follow(const otx_constraint_set *set)
{
    return set->follow == OTX_FOLLOW_AXIS
               ? print_vector(set->axis)
               : json_string(
                     set->follow == OTX_FOLLOW_EDGES ? "edges" : "curvature");
}

json_t *
otx_saved_constraints_print(const otx_constraint_set *set)
{
    json_t *out, *items;

    if (!set)
        return json_null();
    out = json_object();
    items = json_array();
    for (int32_t i = 0; i < set->count; ++i)
        json_array_append_new(items, print_item(&set->items[i]));
    json_object_set_new(out, "constraints", items);
    if (set->symmetry > 0)
        json_object_set_new(out, "symmetry", json_integer(set->symmetry));
    if (set->follow != OTX_FOLLOW_NOTHING)
        json_object_set_new(out, "follow", print_follow(set));
    if (set->follow_length > 0.0)
        json_object_set_new(
            out, "follow-length", json_real(set->follow_length));
    return out;
}
