/* door.c -- who is let in. */
#include "studio/door.h"

#include <stdio.h>
#include <string.h>
#include <sys/random.h>

bool
otx_door_make(otx_door *door)
{
    unsigned char bytes[(OTX_DOOR_TOKEN_BYTES - 1) / 2];

    if (getrandom(bytes, sizeof bytes, 0) != (ssize_t)sizeof bytes)
        return false;
    for (size_t i = 0; i < sizeof bytes; ++i)
        snprintf(door->token + 2 * i, 3, "%02x", bytes[i]);
    return true;
}

const char *
otx_door_path(const otx_door *door, const char *url)
{
    const size_t length = OTX_DOOR_TOKEN_BYTES - 1;
    unsigned char differs = 0;

    if (strnlen(url, length + 2) < length + 2 || url[0] != '/' ||
        url[length + 1] != '/')
        return NULL;
    for (size_t i = 0; i < length; ++i)
        differs |= (unsigned char)(url[i + 1] ^ door->token[i]);
    return differs ? NULL : url + length + 2;
}

/* "127.0.0.1:PORT" or "localhost:PORT", behind `before`. */
static bool
is_here(const otx_door *door, const char *name, const char *before)
{
    static const char *const hosts[] = {"127.0.0.1", "localhost"};
    char own[64];

    for (int i = 0; i < 2; ++i)
    {
        snprintf(own, sizeof own, "%s%s:%u", before, hosts[i], door->port);
        if (strcmp(name, own) == 0)
            return true;
    }
    return false;
}

bool
otx_door_is_ours(const otx_door *door, const otx_door_names *names)
{
    if (!names->host || !is_here(door, names->host, ""))
        return false;
    if (names->origin && !is_here(door, names->origin, "http://"))
        return false;
    return !names->site || strcmp(names->site, "same-origin") == 0 ||
           strcmp(names->site, "none") == 0;
}
