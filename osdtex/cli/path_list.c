/* path_list.c -- files by name and by what they are. */
#include "cli/path_list.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* Takes "./" and doubled slashes out of a name, in place. */
static void
tidy(char *name)
{
    char *to = name;

    for (const char *from = name; *from;)
    {
        const size_t length = strcspn(from, "/");

        if (length > 0 && !(length == 1 && *from == '.'))
        {
            memmove(to, from, length);
            to += length;
            if (from[length])
                *to++ = '/';
        }
        from += length + (from[length] == '/');
    }
    *to = '\0';
}

/* Looks up the nearest folder of a name that is there. */
static bool
find_folder(otx_path *path)
{
    char *folder = strdup(path->name);
    size_t length = folder ? strlen(folder) : 0;
    struct stat info;
    bool found = false;

    while (folder && !found)
    {
        while (length > 0 && folder[length - 1] != '/')
            --length;
        folder[length] = '\0';
        found = stat(length > 0 ? folder : ".", &info) == 0;
        if (length == 0)
            break;
        length -= !found;
    }
    free(folder);
    if (!found)
        return false;
    path->rest = strdup(path->name + length);
    path->folder_device = info.st_dev;
    path->folder_inode = info.st_ino;
    if (path->rest)
        tidy(path->rest);
    return path->rest != NULL;
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
    if (!path.name || !find_folder(&path) || !grow(list))
    {
        free(path.name);
        free(path.rest);
        list->out_of_memory = true;
        return;
    }
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
    {
        free(list->items[i].name);
        free(list->items[i].rest);
    }
    free(list->items);
    *list = (otx_path_list){0};
}

static int
order_numbers(uint64_t a, uint64_t b)
{
    return a < b ? -1 : a > b;
}

int
otx_path_list_order(const otx_path *a, const otx_path *b)
{
    const bool exist = a->exists && b->exists;
    int order = order_numbers(a->exists, b->exists);

    if (order == 0)
        order = order_numbers(
            exist ? a->device : a->folder_device,
            exist ? b->device : b->folder_device);
    if (order == 0)
        order = order_numbers(
            exist ? a->inode : a->folder_inode,
            exist ? b->inode : b->folder_inode);
    return order != 0 || exist ? order : strcasecmp(a->rest, b->rest);
}

bool
otx_path_list_is_same(const otx_path *a, const otx_path *b)
{
    return otx_path_list_order(a, b) == 0;
}

const otx_path *
otx_path_list_find(const otx_path_list *list, const otx_path *path)
{
    for (int i = 0; i < list->count; ++i)
        if (otx_path_list_is_same(&list->items[i], path))
            return &list->items[i];
    return NULL;
}

bool
otx_path_list_is_folder(const char *name)
{
    struct stat info;

    return stat(name, &info) == 0 && S_ISDIR(info.st_mode);
}
