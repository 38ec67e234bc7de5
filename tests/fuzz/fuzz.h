/* fuzz.h -- what the fuzz targets share.
 *
 * A target is one function that libFuzzer calls with bytes. `tools/fuzz` builds
 * them with it; the tests link the same functions with replay.c, which calls
 * them with the files of tests/fuzz/corpus/. */
#ifndef OTX_TESTS_FUZZ_H
#define OTX_TESTS_FUZZ_H

#include <osdtex/osdtex.h>

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* What must hold for every input, in every build. */
#define fuzz_check(holds)                                                      \
    do                                                                         \
    {                                                                          \
        if (!(holds))                                                          \
            abort();                                                           \
    } while (0)

/* Writes the bytes to a file called `name` in a folder of this process, which
 * goes when it ends, and returns its path. */
const char *fuzz_file(const char *name, const uint8_t *data, size_t size);

/* The folder, without a slash at its end. */
const char *fuzz_folder(void);

/* A context with little memory and one thread. */
osdtex_context *fuzz_context(void);

/* Ends with abort() where an error of the context is no sentence, or a call
 * that failed gave something. */
void fuzz_judge(
    const osdtex_context *context, osdtex_status status, const void *out);

#endif
