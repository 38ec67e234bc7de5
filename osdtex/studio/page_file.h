/* page_file.h -- the files of the page, which the build puts into the program.
 */
#ifndef OTX_STUDIO_PAGE_FILE_H
#define OTX_STUDIO_PAGE_FILE_H

#include <stddef.h>

typedef struct otx_page_file
{
    const char *name; /* "main.js"; "" is the page itself */
    const char *type;
    const unsigned char *data;
    size_t bytes;
} otx_page_file;

/* Made by tools/cmake/Page.cmake; a NULL name behind the last. */
extern const otx_page_file otx_page_files[];

/* NULL for others. */
const otx_page_file *otx_page_file_find(const char *name);

#endif
