/* defaults.c -- the defaults of every options struct, as exported functions.
 *
 * Bindings can't call the inline functions of the headers, and must not copy
 * what these do. */
#include <osdtex/osdtex.h>

#include <string.h>

/* Writes at most what both know: a host that was built against an older header
 * has a shorter struct. `ours` begins with its size. */
static void
give(void *out, size_t bytes, const void *ours, size_t our_bytes)
{
    if (!out || bytes < sizeof bytes)
        return;
    memset(out, 0, bytes);
    memcpy(out, ours, bytes < our_bytes ? bytes : our_bytes);
    memcpy(out, &bytes, sizeof bytes);
}

#define DEFINE_INIT(name, make)                                                \
    void name##_init(name *out, size_t bytes)                                  \
    {                                                                          \
        const name ours = make();                                              \
                                                                               \
        give(out, bytes, &ours, sizeof ours);                                  \
    }

DEFINE_INIT(osdtex_bake_options, osdtex_bake_options_default)
DEFINE_INIT(osdtex_bake_sink, osdtex_bake_sink_none)
DEFINE_INIT(osdtex_cage_options, osdtex_cage_options_default)
DEFINE_INIT(osdtex_cage_arrays, osdtex_cage_arrays_none)
DEFINE_INIT(osdtex_context_options, osdtex_context_options_default)
DEFINE_INIT(osdtex_exemplar_options, osdtex_exemplar_options_default)
DEFINE_INIT(osdtex_job, osdtex_job_none)
DEFINE_INIT(osdtex_field_options, osdtex_field_options_default)
DEFINE_INIT(osdtex_constraint, osdtex_constraint_none)
DEFINE_INIT(osdtex_map_options, osdtex_map_options_default)
DEFINE_INIT(osdtex_edit_options, osdtex_edit_options_default)
DEFINE_INIT(osdtex_write_options, osdtex_write_options_default)
DEFINE_INIT(osdtex_mapping_read_options, osdtex_mapping_read_options_default)
DEFINE_INIT(osdtex_render_options, osdtex_render_options_default)
DEFINE_INIT(osdtex_report_options, osdtex_report_options_default)
DEFINE_INIT(osdtex_stack_options, osdtex_stack_options_default)
DEFINE_INIT(osdtex_surface_options, osdtex_surface_options_default)
DEFINE_INIT(osdtex_tiles_options, osdtex_tiles_options_default)
