/* process.h -- running a program as a child, so that its death is an
 * observation and not ours. */
#ifndef OTX_REGRESS_PROCESS_H
#define OTX_REGRESS_PROCESS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Wall seconds of a clock that never goes back. */
double otx_process_seconds(void);

/* The words of a command line, NULL behind the last. Begins as {0}. */
typedef struct otx_process_words
{
    char **items;
    size_t count;
    bool failed; /* memory ran out; the words are not whole */
} otx_process_words;

void otx_process_add(otx_process_words *words, const char *word);
/* The words of `text`, which stand between blanks. NULL adds none. */
void otx_process_add_text(otx_process_words *words, const char *text);
/* Prints the first `length` bytes of a text as one word of a shell: in quotes
 * where it needs them. */
void otx_process_put_word(FILE *out, const char *text, size_t length);
/* As a person would type it, quoted for a shell. To be freed; NULL when memory
 * ran out. */
char *otx_process_line(const otx_process_words *words);
void otx_process_free(otx_process_words *words);

typedef struct otx_process_end
{
    int exit_code;  /* -1: killed by a signal */
    int signal;     /* 0 none */
    bool timed_out; /* we killed it */
    bool stopped;   /* we killed it, as `stop` asked */
    double wall;    /* seconds */
    double cpu;     /* seconds, user and system, all threads */
} otx_process_end;

typedef struct otx_process_options
{
    const char *log;    /* gets what it prints, appended */
    double timeout;     /* seconds */
    bool (*stop)(void); /* asked a hundred times a second */
} otx_process_options;

/* Runs the words and waits. False when the child could not be started. */
bool otx_process_run(
    const otx_process_words *words, const otx_process_options *options,
    otx_process_end *out);

#endif
