/* path_list.h -- files by name and by what they are.
 *
 * Two names are one file when the system says so (device and inode, whatever
 * links, case or `./` are in the names) or, of files that are not there yet,
 * when they have one name in one folder. */
#ifndef OTX_CLI_PATH_LIST_H
#define OTX_CLI_PATH_LIST_H

#include <stdbool.h>
#include <sys/types.h>

typedef struct otx_path
{
    char *name;
    char *rest; /* of the name behind the nearest folder that is there, without
                 * "./" and doubled slashes; a plain name where its folder is */
    bool exists;
    dev_t device, folder_device; /* of the file, of that folder */
    ino_t inode, folder_inode;
} otx_path;

/* Begin with {0}. */
typedef struct otx_path_list
{
    otx_path *items;
    int count, room;
    bool out_of_memory; /* an item is missing */
} otx_path_list;

/* Adds a copy of a name and looks at what it stands for now. NULL and "" are
 * passed over. */
void otx_path_list_add(otx_path_list *list, const char *name);
void otx_path_list_free(otx_path_list *list);

/* Whether there is a folder of this name. */
bool otx_path_list_is_folder(const char *name);

/* Whether two names are of one file. Of files that are not there, names that
 * differ in case only count as one: on many systems they are. */
bool otx_path_list_is_same(const otx_path *a, const otx_path *b);

/* An order in which two names of one file are neighbours. */
int otx_path_list_order(const otx_path *a, const otx_path *b);

/* The first of the list that is the file of `path`; NULL none. */
const otx_path *
otx_path_list_find(const otx_path_list *list, const otx_path *path);

#endif
