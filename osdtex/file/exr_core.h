/* exr_core.h -- how files are opened by OpenEXR's C core, everywhere alike. */
#ifndef OTX_FILE_EXR_CORE_H
#define OTX_FILE_EXR_CORE_H

#include <OpenEXR/openexr.h>

/* Without a handler the core prints. What it says may quote bytes of the file,
 * so only its fixed messages are passed on. */
static inline void
otx_exr_say_nothing(
    exr_const_context_t file, exr_result_t code, const char *message)
{
    (void)file;
    (void)code;
    (void)message;
}

static inline exr_context_initializer_t
otx_exr_core_writing(void)
{
    exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;

    setup.error_handler_fn = otx_exr_say_nothing;
    return setup;
}

/* Rebuilding a damaged offset table means to search the whole file. */
static inline exr_context_initializer_t
otx_exr_core_reading(void)
{
    exr_context_initializer_t setup = otx_exr_core_writing();

    setup.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION |
                  EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE;
    return setup;
}

#endif
