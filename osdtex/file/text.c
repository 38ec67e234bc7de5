/* text.c -- reads text files whole and cuts them into lines and tokens.
 *
 * The bytes are our own copy, so a continuation is joined in place: backslash
 * and line end become blanks, and the last byte of the line end becomes a NUL,
 * which a text does not otherwise hold. It is a blank that still counts as a
 * line, so going over the file a second time finds the same line numbers. */
#include "file/text.h"

#include "bridge/charconv.h"
#include "file/foreign.h"

#include <errno.h>
#include <fcntl.h>
#include <float.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum
{
    FIRST_CAPACITY = 1 << 16,
    JOINED_LINE_END = '\0'
};

static bool
is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' ||
           c == JOINED_LINE_END;
}

static bool
is_line_end(char c)
{
    return c == '\n' || c == '\r';
}

otx_where
otx_text_where(const otx_text *text)
{
    otx_where where = otx_where_file(text->name);

    where.line = text->line;
    return where;
}

/* A whole file, growing: pipes do not know their size beforehand. */
typedef struct content
{
    char *bytes;
    size_t size, capacity;
} content;

static bool
grow(otx_run *run, content *c)
{
    const size_t capacity = c->capacity * 2;
    char *bytes = OTX_NEW(run->scratch, char, capacity);

    if (!bytes)
        return false;
    memcpy(bytes, c->bytes, c->size);
    c->bytes = bytes;
    c->capacity = capacity;
    return true;
}

static otx_status
fail_errno(otx_run *run, const char *stage, const char *path, int error)
{
    return otx_fail(
        run, OSDTEX_ERROR_IO, stage, otx_where_file(path),
        "the file cannot be read: %s", strerror(error));
}

static otx_status
read_all(
    otx_run *run, const char *stage, const char *path, int fd, size_t limit,
    content *c)
{
    for (;;)
    {
        ssize_t got;

        if (c->size == c->capacity && !grow(run, c))
            return otx_fail_memory(run, stage);
        got = read(fd, c->bytes + c->size, c->capacity - c->size);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            return fail_errno(run, stage, path, errno);
        if (got == 0)
            return OSDTEX_OK;
        c->size += (size_t)got;
        if (c->size > limit)
            return otx_fail(
                run, OSDTEX_ERROR_LIMIT, stage, otx_where_file(path),
                "the file is larger than %zu MiB, the most that is read",
                limit >> 20);
    }
}

/* Room for the file and one byte more, so that its end is found without
 * growing. */
static otx_status
read_open(
    otx_run *run, const char *stage, const char *path, int fd, size_t limit,
    content *c)
{
    struct stat info;

    if (fstat(fd, &info) != 0)
        return fail_errno(run, stage, path, errno);
    if (S_ISDIR(info.st_mode))
        return fail_errno(run, stage, path, EISDIR);
    if (!S_ISREG(info.st_mode) && !S_ISFIFO(info.st_mode))
        return otx_fail(
            run, OSDTEX_ERROR_IO, stage, otx_where_file(path),
            "this is neither a file nor a pipe");
    if (info.st_size > 0 && (size_t)info.st_size <= limit)
        c->capacity = (size_t)info.st_size + 1;
    if (c->capacity < FIRST_CAPACITY)
        c->capacity = FIRST_CAPACITY;
    c->bytes = OTX_NEW(run->scratch, char, c->capacity);
    OTX_TRY(otx_run_ok(run));
    return read_all(run, stage, path, fd, limit, c);
}

/* Text starts with no UTF-16 mark and holds no zero byte. */
static otx_status
check_text(otx_text *text)
{
    static const char little[] = {'\xFF', '\xFE'}, big[] = {'\xFE', '\xFF'};
    const size_t size = (size_t)(text->end - text->bytes);
    const char *kind;

    if (size == 0)
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage,
            otx_where_file(text->name), "the file is empty");
    if (size >= 2 && (memcmp(text->bytes, little, 2) == 0 ||
                      memcmp(text->bytes, big, 2) == 0))
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage,
            otx_where_file(text->name), "the text is UTF-16; save it as UTF-8");
    kind = otx_foreign_kind(text->bytes, size);
    if (kind)
        return otx_fail(
            text->run, OSDTEX_ERROR_SUPPORT, text->stage,
            otx_where_file(text->name),
            "this is %s, which is not read here; cages are OBJ files: export "
            "it as one",
            kind);
    if (memchr(text->bytes, '\0', size))
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage,
            otx_where_file(text->name),
            "the file holds zero bytes: it is binary, damaged, or UTF-16; "
            "save it as UTF-8 text");
    return OSDTEX_OK;
}

static otx_status
start(
    otx_run *run, const char *stage, const char *name, char *bytes, size_t size,
    otx_text *out)
{
    otx_text text = {
        .run = run,
        .stage = stage,
        .name = name,
        .bytes = bytes,
        .end = bytes + size};

    OTX_TRY(check_text(&text));
    if (size >= 3 && memcmp(bytes, "\xEF\xBB\xBF", 3) == 0)
        text.bytes += 3;
    otx_text_rewind(&text);
    *out = text;
    return OSDTEX_OK;
}

otx_status
otx_text_read(
    otx_run *run, const char *stage, const char *path, size_t limit_bytes,
    otx_text *out)
{
    const int fd = open(path, O_RDONLY | O_CLOEXEC);
    content c = {0};
    otx_status status;

    if (fd < 0)
        return fail_errno(run, stage, path, errno);
    status = read_open(run, stage, path, fd, limit_bytes, &c);
    close(fd);
    OTX_TRY(status);
    return start(run, stage, path, c.bytes, c.size, out);
}

otx_status
otx_text_open(
    otx_run *run, const char *stage, const char *name, const char *bytes,
    size_t size, otx_text *out)
{
    char *copy = OTX_NEW(run->scratch, char, size);

    OTX_TRY(otx_run_ok(run));
    if (size > 0)
        memcpy(copy, bytes, size);
    return start(run, stage, name, copy, size, out);
}

void
otx_text_rewind(otx_text *text)
{
    text->line = 0;
    text->rest = (otx_token){text->bytes, text->bytes};
    text->next = text->bytes;
    text->next_line = 1;
}

static const char *
skip_blanks(const char *at, const char *end)
{
    while (at != end && is_blank(*at))
        ++at;
    return at;
}

/* The end of the physical line at `at`, counting lines that were joined to
 * it before. */
static char *
find_line_end(otx_text *text, char *at)
{
    for (; at != text->end && !is_line_end(*at); ++at)
        text->next_line += *at == JOINED_LINE_END;
    return at;
}

static char *
skip_line_end(const otx_text *text, char *at)
{
    if (at == text->end)
        return at;
    if (*at == '\r' && at + 1 != text->end && at[1] == '\n')
        ++at;
    return at + 1;
}

static bool
is_comment(const char *at, const char *end)
{
    at = skip_blanks(at, end);
    return at != end && *at == '#';
}

bool
otx_text_next(otx_text *text)
{
    char *at = text->next, *end;

    if (at == text->end)
        return false;
    const bool comment = is_comment(at, text->end);

    text->line = text->next_line;
    text->rest.begin = at;
    for (;;)
    {
        end = find_line_end(text, at);
        text->next = skip_line_end(text, end);
        if (comment || end == text->end || end == text->rest.begin ||
            end[-1] != '\\')
            break;
        memset(end - 1, ' ', (size_t)(text->next - end));
        at = text->next - 1;
        *at = JOINED_LINE_END;
    }
    text->rest.end = end;
    ++text->next_line;
    return true;
}

static bool
take(otx_token *rest, otx_token *out)
{
    const char *at = skip_blanks(rest->begin, rest->end);

    if (at == rest->end || *at == '#')
    {
        rest->begin = rest->end;
        return false;
    }
    out->begin = at;
    while (at != rest->end && !is_blank(*at))
        ++at;
    out->end = rest->begin = at;
    return true;
}

bool
otx_text_token(otx_text *text, otx_token *out)
{
    return take(&text->rest, out);
}

int64_t
otx_text_count(const otx_text *text)
{
    otx_token rest = text->rest, token;
    int64_t count = 0;

    while (take(&rest, &token))
        ++count;
    return count;
}

otx_token
otx_text_remainder(otx_text *text)
{
    otx_token all = text->rest;

    all.begin = skip_blanks(all.begin, all.end);
    while (all.begin != all.end && is_blank(all.end[-1]))
        --all.end;
    text->rest.begin = text->rest.end;
    return all;
}

static otx_status
fail_number(
    const otx_text *text, otx_token token, const char *what,
    otx_charconv_result result)
{
    const otx_text_quote quote = otx_token_quote(token);

    if (result == OTX_CHARCONV_OVERFLOW)
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage, otx_text_where(text),
            "%s '%s' is too large", what, quote.text);
    return otx_fail(
        text->run, OSDTEX_ERROR_FORMAT, text->stage, otx_text_where(text),
        "%s '%s' is not a number", what, quote.text);
}

/* Whether what was read of a token is a number that can be used.
 *
 *   value  in the type's range only when `result` is OK */
static otx_status
check_number(
    const otx_text *text, otx_token token, const char *what,
    otx_charconv_result result, const char *rest, double value)
{
    if (result == OTX_CHARCONV_MALFORMED || rest != token.end)
        return fail_number(text, token, what, OTX_CHARCONV_MALFORMED);
    if (result == OTX_CHARCONV_OK && isfinite(value) && fabs(value) > FLT_MAX)
        result = OTX_CHARCONV_OVERFLOW;
    if (result != OTX_CHARCONV_OK)
        return fail_number(text, token, what, result);
    if (isfinite(value))
        return OSDTEX_OK;

    const otx_text_quote quote = otx_token_quote(token);

    return otx_fail(
        text->run, OSDTEX_ERROR_FORMAT, text->stage, otx_text_where(text),
        "%s '%s' is not a finite number", what, quote.text);
}

otx_status
otx_text_parse_float(
    const otx_text *text, otx_token token, const char *what, float *value)
{
    const char *rest = token.begin;
    const otx_charconv_result result =
        otx_charconv_read_float(token.begin, token.end, value, &rest);

    return check_number(text, token, what, result, rest, (double)*value);
}

otx_status
otx_text_parse_double(
    const otx_text *text, otx_token token, const char *what, double *value)
{
    const char *rest = token.begin;
    const otx_charconv_result result =
        otx_charconv_read_double(token.begin, token.end, value, &rest);

    return check_number(text, token, what, result, rest, *value);
}

otx_status
otx_text_parse_int(
    const otx_text *text, otx_token token, const char *what, int64_t *value)
{
    const char *rest = token.begin;
    otx_charconv_result result =
        otx_charconv_read_int(token.begin, token.end, value, &rest);

    if (rest != token.end)
        result = OTX_CHARCONV_MALFORMED;
    if (result != OTX_CHARCONV_OK)
        return fail_number(text, token, what, result);
    return OSDTEX_OK;
}

otx_status
otx_text_float(otx_text *text, const char *what, float *value)
{
    otx_token token;

    if (!otx_text_token(text, &token))
        return otx_fail(
            text->run, OSDTEX_ERROR_FORMAT, text->stage, otx_text_where(text),
            "the line ends where its %s should be", what);
    return otx_text_parse_float(text, token, what, value);
}

/* What a byte of a token stands for: where a name was continued on the next
 * line there is a blank. */
static char
token_char(char c)
{
    return c == JOINED_LINE_END ? ' ' : c;
}

bool
otx_token_is(otx_token token, const char *word)
{
    for (const char *at = token.begin; at != token.end; ++at, ++word)
    {
        if (*word != token_char(*at))
            return false;
    }
    return *word == '\0';
}

/* FNV-1a, which is good enough for names. */
uint32_t
otx_token_hash(otx_token token)
{
    uint32_t hash = 0x811C9DC5u;

    for (const char *at = token.begin; at != token.end; ++at)
        hash = (hash ^ (unsigned char)token_char(*at)) * 0x01000193u;
    return hash;
}

otx_text_quote
otx_token_quote(otx_token token)
{
    static const char ellipsis[] = "...";
    otx_text_quote quote;
    size_t size = (size_t)(token.end - token.begin);
    const bool cut = size >= sizeof quote.text;

    if (cut)
        size = sizeof quote.text - sizeof ellipsis;
    for (size_t i = 0; i < size; ++i)
    {
        const unsigned char c = (unsigned char)token.begin[i];

        quote.text[i] = c < ' ' || c >= 0x7F ? '?' : (char)c;
    }
    quote.text[size] = '\0';
    if (cut)
        memcpy(quote.text + size, ellipsis, sizeof ellipsis);
    return quote;
}

char *
otx_token_copy(otx_arena *arena, otx_token token)
{
    const size_t size = (size_t)(token.end - token.begin);
    char *copy = OTX_NEW(arena, char, size + 1);

    if (!copy)
        return NULL;
    for (size_t i = 0; i < size; ++i)
        copy[i] = token_char(token.begin[i]);
    copy[size] = '\0';
    return copy;
}
