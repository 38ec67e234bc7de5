/* path_list.c -- files by name and by what they are. */
#include "cli/path_list.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

static const char *
base_of(const char *name)
{
    const char *slash = strrchr(name, '/');

    return slash ? slash + 1 : name;
}

/* Looks up the folder that a name is in. */
static bool
find_folder(otx_path *path)
{
    const size_t length = (size_t)(base_of(path->name) - path->name);
    char *folder = length > 0 ? strndup(path->name, length) : strdup(".");
    struct stat info;
    const bool found = folder && stat(folder, &info) == 0;

    free(folder);
    if (!found)
        return false;
    path->folder_device = info.st_dev;
    path->folder_inode = info.st_ino;
    return true;
}

static bool
grow(otx_path_list *list)
{
    const int room = list->room > 0 ? 2 * list->room : 16;
    otx_path *items;

    if (list->count < list->room)
        return true;
    items = realloc(list->items, (size_t)room * sizeof *items);
    if (!items)
        return false;
    list->items = items;
    list->room = room;
    return true;
}

void
otx_path_list_add(otx_path_list *list, const char *name)
{
    otx_path path = {0};
    struct stat info;

    if (!name || !*name)
        return;
    path.name = strdup(name);
    if (!path.name || !grow(list))
    {
        free(path.name);
        list->out_of_memory = true;
        return;
    }
    path.has_folder = find_folder(&path);
    path.exists = stat(name, &info) == 0;
    if (path.exists)
    {
        path.device = info.st_dev;
        path.inode = info.st_ino;
    }
    list->items[list->count++] = path;
}

void
otx_path_list_free(otx_path_list *list)
{
    for (int i = 0; i < list->count; ++i)
        free(list->items[i].name);
    free(list->items);
    *list = (otx_path_list){0};
}

bool
otx_path_list_is_same(const otx_path *a, const otx_path *b)
{
    if (a->exists && b->exists)
        return a->device == b->device && a->inode == b->inode;
    if (a->exists || b->exists)
        return false;
    return a->has_folder && b->has_folder &&
           a->folder_device == b->folder_device &&
           a->folder_inode == b->folder_inode &&
           strcasecmp(base_of(a->name), base_of(b->name)) == 0;
}

const otx_path *
otx_path_list_find(const otx_path_list *list, const otx_path *path)
{
    for (int i = 0; i < list->count; ++i)
        if (otx_path_list_is_same(&list->items[i], path))
            return &list->items[i];
    return NULL;
}
