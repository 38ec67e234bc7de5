/* server.c -- HTTP on the loopback address. */
#include "studio/server.h"

#include "studio/page_file.h"
#include "studio/sentence.h"
#include "studio/wire.h"

#include <arpa/inet.h>
#include <microhttpd.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct MHD_Connection connection;
typedef enum MHD_Result result;

enum
{
    BODY_MOST = 16 << 20,
    CONNECTIONS_MOST = 64,
    IDLE_SECONDS = 120,
    TEXTURE_MOST = 2048
};

/* A request with its body, while it comes in. */
typedef struct request
{
    char *body;
    size_t bytes;
    bool is_too_large;
} request;

/* -- answers -------------------------------------------------------------- */

/* Sends a response and lets it go. */
static result
send_response(
    connection *c, unsigned status, struct MHD_Response *response,
    const char *type)
{
    static const char *const headers[][2] = {
        {"Cache-Control", "no-store"},
        {"Referrer-Policy", "no-referrer"},
        {"X-Content-Type-Options", "nosniff"},
        {"Cross-Origin-Resource-Policy", "same-origin"},
        {"X-Frame-Options", "DENY"},
        {"Content-Security-Policy",
         "default-src 'self'; img-src 'self' blob: data:; object-src 'none'; "
         "base-uri 'none'; frame-ancestors 'none'"}};
    result done;

    if (!response)
        return MHD_NO;
    MHD_add_response_header(response, MHD_HTTP_HEADER_CONTENT_TYPE, type);
    for (size_t i = 0; i < sizeof headers / sizeof *headers; ++i)
        MHD_add_response_header(response, headers[i][0], headers[i][1]);
    done = MHD_queue_response(c, status, response);
    MHD_destroy_response(response);
    return done;
}

static result
say(connection *c, unsigned status, const char *sentence)
{
    return send_response(
        c, status,
        MHD_create_response_from_buffer(
            strlen(sentence), (void *)(uintptr_t)sentence,
            MHD_RESPMEM_MUST_COPY),
        "text/plain; charset=utf-8");
}

/* Takes the bytes. */
static result
send_bytes(connection *c, void *bytes, size_t count, const char *type)
{
    struct MHD_Response *response;

    if (!bytes)
        return say(c, MHD_HTTP_INTERNAL_SERVER_ERROR, "memory is out");
    response =
        MHD_create_response_from_buffer(count, bytes, MHD_RESPMEM_MUST_FREE);
    if (!response)
        free(bytes);
    return send_response(c, MHD_HTTP_OK, response, type);
}

/* -- what is asked for ----------------------------------------------------- */

static int64_t
number_of(connection *c, const char *key)
{
    const char *text =
        MHD_lookup_connection_value(c, MHD_GET_ARGUMENT_KIND, key);

    return text ? strtoll(text, NULL, 10) : 0;
}

static result
get_state(const otx_server *server, connection *c)
{
    char *text = otx_desk_tell(server->desk, number_of(c, "after"));

    return send_bytes(
        c, text, text ? strlen(text) : 0, "application/json; charset=utf-8");
}

static result
get_block(const otx_server *server, connection *c, const char *path)
{
    otx_snapshot *s = otx_desk_snapshot(server->desk);
    const int64_t index = number_of(c, "index");
    otx_wire w = {NULL, 0};

    if (!s)
        return say(c, MHD_HTTP_NOT_FOUND, "there is no picture yet");
    if (strcmp(path, "surface") == 0)
        w = otx_wire_surface(s);
    else if (strcmp(path, "mapping") == 0)
        w = otx_wire_mapping(s);
    else if (strcmp(path, "seams") == 0)
        w = otx_wire_seams(s);
    else if (
        index >= 0 && index < OTX_SNAPSHOT_EXEMPLARS_MAX &&
        s->outcome->exemplars[index])
        w = otx_wire_texture(s->outcome->exemplars[index], TEXTURE_MOST);
    otx_snapshot_release(s);
    return send_bytes(c, w.bytes, w.count, "application/octet-stream");
}

static result
get(const otx_server *server, connection *c, const char *path)
{
    const otx_page_file *file = otx_page_file_find(path);

    if (file)
        return send_response(
            c, MHD_HTTP_OK,
            MHD_create_response_from_buffer(
                file->bytes, (void *)(uintptr_t)file->data,
                MHD_RESPMEM_PERSISTENT),
            file->type);
    if (strcmp(path, "state") == 0)
        return get_state(server, c);
    if (strcmp(path, "surface") == 0 || strcmp(path, "mapping") == 0 ||
        strcmp(path, "seams") == 0 || strcmp(path, "texture") == 0)
        return get_block(server, c, path);
    return say(c, MHD_HTTP_NOT_FOUND, "there is no such page");
}

static result
post(
    const otx_server *server, connection *c, const char *path, const request *r)
{
    char error[OTX_STUDIO_ERROR_BYTES] = "";
    bool is_done = true;

    if (strcmp(path, "recipe") == 0)
        is_done = otx_desk_put(
            server->desk, r->body ? r->body : "", r->bytes,
            number_of(c, "revision"), error);
    else if (strcmp(path, "undo") == 0 || strcmp(path, "redo") == 0)
        is_done = otx_desk_step(server->desk, path[0] == 'u' ? -1 : 1, error);
    else if (strcmp(path, "cancel") == 0)
        otx_desk_cancel(server->desk);
    else if (strcmp(path, "export") == 0)
        otx_desk_export(server->desk);
    else
        return say(c, MHD_HTTP_NOT_FOUND, "there is no such page");
    return say(c, is_done ? MHD_HTTP_OK : MHD_HTTP_BAD_REQUEST, error);
}

/* -- requests ------------------------------------------------------------- */

static const char *
header_of(connection *c, const char *name)
{
    return MHD_lookup_connection_value(c, MHD_HEADER_KIND, name);
}

static bool
is_let_in(const otx_server *server, connection *c)
{
    const otx_door_names names = {
        .host = header_of(c, MHD_HTTP_HEADER_HOST),
        .origin = header_of(c, MHD_HTTP_HEADER_ORIGIN),
        .site = header_of(c, "Sec-Fetch-Site")};

    return otx_door_is_ours(&server->door, &names);
}

/* Adds what came in. */
static void
take_body(request *r, const char *data, size_t bytes)
{
    char *more;

    if (r->is_too_large || r->bytes + bytes > BODY_MOST)
    {
        r->is_too_large = true;
        return;
    }
    more = realloc(r->body, r->bytes + bytes);
    if (!more)
    {
        r->is_too_large = true;
        return;
    }
    memcpy(more + r->bytes, data, bytes);
    r->body = more;
    r->bytes += bytes;
}

static result
answer(
    void *user, connection *c, const char *url, const char *method,
    const char *version, const char *data, size_t *bytes, void **state)
{
    const otx_server *server = user;
    const char *path = otx_door_path(&server->door, url);
    request *r = *state;

    (void)version;
    if (!r)
    {
        *state = calloc(1, sizeof(request));
        return *state ? MHD_YES : MHD_NO;
    }
    if (*bytes > 0)
    {
        if (path)
            take_body(r, data, *bytes);
        *bytes = 0;
        return MHD_YES;
    }
    if (!path || !is_let_in(server, c))
        return say(
            c, MHD_HTTP_FORBIDDEN,
            "this is open to the page only whose address osdtex studio "
            "printed");
    if (r->is_too_large)
        return say(c, MHD_HTTP_CONTENT_TOO_LARGE, "what was sent is too large");
    if (strcmp(method, MHD_HTTP_METHOD_GET) == 0)
        return get(server, c, path);
    if (strcmp(method, MHD_HTTP_METHOD_POST) == 0)
        return post(server, c, path, r);
    return say(c, MHD_HTTP_METHOD_NOT_ALLOWED, "only GET and POST are known");
}

static void
forget(
    void *user, connection *c, void **state,
    enum MHD_RequestTerminationCode code)
{
    request *r = *state;

    (void)user;
    (void)c;
    (void)code;
    if (r)
        free(r->body);
    free(r);
    *state = NULL;
}

bool
otx_server_start(
    otx_desk *desk, otx_server *server, char error[OTX_STUDIO_ERROR_BYTES])
{
    struct sockaddr_in here = {.sin_family = AF_INET};
    const union MHD_DaemonInfo *info;

    *server = (otx_server){.desk = desk};
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (otx_door_make(&server->door))
        server->daemon = MHD_start_daemon(
            MHD_USE_INTERNAL_POLLING_THREAD | MHD_USE_THREAD_PER_CONNECTION, 0,
            NULL, NULL, answer, server, MHD_OPTION_SOCK_ADDR, &here,
            MHD_OPTION_NOTIFY_COMPLETED, forget, NULL,
            MHD_OPTION_CONNECTION_LIMIT, (unsigned)CONNECTIONS_MOST,
            MHD_OPTION_CONNECTION_TIMEOUT, (unsigned)IDLE_SECONDS,
            MHD_OPTION_END);
    info = server->daemon
               ? MHD_get_daemon_info(server->daemon, MHD_DAEMON_INFO_BIND_PORT)
               : NULL;
    if (info)
    {
        server->door.port = info->port;
        return true;
    }
    otx_sentence(error, "no port of the loopback address can be listened on");
    otx_server_stop(server);
    return false;
}

void
otx_server_stop(otx_server *server)
{
    if (server->daemon)
        MHD_stop_daemon(server->daemon);
    server->daemon = NULL;
}
