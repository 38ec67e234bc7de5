/* page_file.c -- the files of the page, which the build puts into the program.
 */
#include "studio/page_file.h"

#include <string.h>

const otx_page_file *
otx_page_file_find(const char *name)
{
    for (const otx_page_file *file = otx_page_files; file->name; ++file)
        if (strcmp(file->name, name) == 0)
            return file;
    return NULL;
}
