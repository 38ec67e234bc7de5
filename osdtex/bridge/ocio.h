/* ocio.h -- OpenColorIO behind a C interface.
 *
 * A thin layer: it opens a configuration, answers questions about its colour
 * spaces and converts arrays of pixels. What to convert to what is decided in
 * colour/colour. Every entry catches whatever OpenColorIO throws and turns it
 * into OSDTEX_ERROR_COLOUR and one sentence in `message`, a caller's array of
 * OTX_OCIO_MESSAGE_BYTES that is "" on success.
 *
 * A configuration is immutable once opened; it and its conversions may be used
 * from several threads at once. Strings that are returned live as long as the
 * configuration. */
#ifndef OTX_BRIDGE_OCIO_H
#define OTX_BRIDGE_OCIO_H

#include "base/status.h"

#ifdef __cplusplus
extern "C"
{
#endif

    enum
    {
        OTX_OCIO_MESSAGE_BYTES = 512
    };

    /* A configuration. */
    typedef struct otx_ocio otx_ocio;

    /* Opens the configuration file `path`. The file must be a text
     * configuration (not an .ocioz archive) of a version that the installed
     * OpenColorIO knows. Look-up tables are first read when they are needed. */
    otx_status otx_ocio_open(const char *path, otx_ocio **out, char *message);

    /* Whether `path` is a name of a configuration that OpenColorIO itself
     * carries, "ocio://...", from version 2.2 on. An older one does not know
     * them: then those that are known to be of ACES are opened as
     * otx_ocio_open_builtin with ACEScg as scene_linear, and `stands_in` says
     * which version is too old; else it is "". */
    bool otx_ocio_is_carried(const char *path);
    otx_status otx_ocio_open_carried(
        const char *path, otx_ocio **out, char *message, char *stands_in);

    /* Opens the configuration built into osdtex (builtin_config.h). */
    otx_status otx_ocio_open_builtin(otx_ocio **out, char *message);

    /* NULL is fine. */
    void otx_ocio_close(otx_ocio *ocio);

    /* OpenColorIO's own check of the whole configuration. A real configuration
     * may fail it over a space that nobody uses. */
    otx_status otx_ocio_validate(const otx_ocio *ocio, char *message);

    int32_t otx_ocio_space_count(const otx_ocio *ocio);

    /* Name of space `index`, "" out of range. Inactive spaces are included. */
    const char *otx_ocio_space_name(const otx_ocio *ocio, int32_t index);

    /* The proper name of a colour space given by name, alias or role, without
     * regard to case; NULL when the configuration has no such space. */
    const char *otx_ocio_find(const otx_ocio *ocio, const char *name);

    /* The proper name of the space of `role`; NULL where it is not assigned. */
    const char *otx_ocio_role(const otx_ocio *ocio, const char *role);

    /* Name of role `index`, NULL behind the end. */
    const char *otx_ocio_role_name(const otx_ocio *ocio, int32_t index);

    /* Other name `index` of `space`, NULL behind the end. */
    const char *
    otx_ocio_alias(const otx_ocio *ocio, const char *space, int32_t index);

    /* Display `index`, and its view `index`; NULL behind the end. */
    const char *otx_ocio_display(const otx_ocio *ocio, int32_t index);
    const char *
    otx_ocio_view(const otx_ocio *ocio, const char *display, int32_t index);

    /* Everything that a space may be called by: proper names, then aliases,
     * then roles. NULL behind the end. */
    const char *otx_ocio_name(const otx_ocio *ocio, int32_t index);

    /* Whether `space` holds data that is never converted. */
    bool otx_ocio_is_data(const otx_ocio *ocio, const char *space);

    /* "scene-linear", "sdr-video", "log", "data", … or "" where not stated. */
    const char *otx_ocio_encoding(const otx_ocio *ocio, const char *space);

    /* The space that the file rules give to `path`, and the name of the rule;
     * NULL when only the Default rule matches, which says nothing about the
     * file. */
    const char *otx_ocio_file_rule(
        const otx_ocio *ocio, const char *path, const char **rule);

    /* What the conversions of a configuration depend on besides its file. */
    typedef enum otx_ocio_need
    {
        OTX_OCIO_NEED_TEXT,     /* the configuration itself, and by whom read */
        OTX_OCIO_NEED_VARIABLE, /* NAME=value of the context */
        OTX_OCIO_NEED_NAME,     /* a look-up table as the configuration names it
                                 */
        OTX_OCIO_NEED_FILE      /* where that table is, when it is found */
    } otx_ocio_need;

    /* Calls `visit` for everything that a configuration depends on, in an order
     * of its own that is always the same. Text lives until `visit` returns. */
    otx_status otx_ocio_visit_needs(
        const otx_ocio *ocio,
        void (*visit)(void *user, otx_ocio_need need, const char *text),
        void *user, char *message);

    /* A conversion between two spaces of a configuration, on the CPU. */
    typedef struct otx_ocio_conversion otx_ocio_conversion;

    /* `from` and `to` by name, alias or role. */
    otx_status otx_ocio_convert(
        const otx_ocio *ocio, const char *from, const char *to,
        otx_ocio_conversion **out, char *message);

    /* NULL is fine. */
    void otx_ocio_conversion_destroy(otx_ocio_conversion *conversion);

    /* Whether it leaves every pixel as it is. */
    bool otx_ocio_conversion_is_identity(const otx_ocio_conversion *conversion);

    /* Whether no channel of what comes out looks at another one of what goes
     * in. */
    bool otx_ocio_conversion_is_apart(const otx_ocio_conversion *conversion);

    /* Converts in place `count` interleaved pixels of 3 or 4 channels (R, G,
     * B[, A]); A is not touched. */
    otx_status otx_ocio_conversion_apply(
        const otx_ocio_conversion *conversion, float *pixels, int64_t count,
        int32_t channels, char *message);

#ifdef __cplusplus
}
#endif
#endif
