/* atomic_file.h -- output files that appear together, or not at all.
 *
 * Every file of a set is written under a temporary name beside its final one.
 * Commit renames them all; anything else (an error, a cancelled run) removes
 * them, when the arena that the set was begun in is released. So a status that
 * travels up is all the cleaning that an interrupted job needs.
 *
 * What several calls write can be one set, too: a shared set, which a run
 * carries (run->outputs). Then `begin` gives that set, `commit` only says that
 * what was added so far is finished, and `publish` ends it. */
#ifndef OTX_FILE_ATOMIC_FILE_H
#define OTX_FILE_ATOMIC_FILE_H

#include "base/run.h"

typedef struct otx_atomic_file_set otx_atomic_file_set;

/* Begins an empty set; what is not committed when `arena` is released past
 * this point is removed. The shared set of the run, where it has one. */
otx_status otx_atomic_file_begin(
    otx_run *run, otx_arena *arena, otx_atomic_file_set **out);

/* Begins a shared set: for run->outputs of the runs that are to share it. */
otx_status otx_atomic_file_share(
    otx_run *run, otx_arena *arena, otx_atomic_file_set **out);

/* Creates the temporary of `path`, empty, and gives its name in *temporary
 * (it lives in the set's arena) for whoever writes it. Temporaries that killed
 * processes of this machine left in the folder are removed. IO when the folder
 * does not exist or cannot be written to, or `path` is a link, protected, or no
 * plain file. */
otx_status otx_atomic_file_add(
    otx_run *run, otx_atomic_file_set *set, const char *path,
    const char **temporary);

/* Renames all to their final names, in the order they were added. `durable`
 * waits until the disk has the bytes. Who is killed in between leaves a journal
 * by which the next one completes the set. When a rename fails, the others are
 * taken back: what was there before is there again. Of a shared set: says that
 * what was added is finished. */
otx_status
otx_atomic_file_commit(otx_run *run, otx_atomic_file_set *set, bool durable);

/* Seals the finished files of a shared set and, where one of them is durable,
 * waits until the disk has them: what takes time of publishing. */
otx_status otx_atomic_file_seal(otx_run *run, otx_atomic_file_set *set);

/* Says what a file of the set is for, where its name does not: a literal. */
void otx_atomic_file_describe(
    otx_atomic_file_set *set, const char *path, const char *role);

/* A finished file of a set, lent. */
typedef struct otx_atomic_file_entry
{
    const char *path;      /* what it will be called */
    const char *temporary; /* where it is until then */
    const char *role;      /* NULL: nobody said */
} otx_atomic_file_entry;

/* The finished file number `index`, in the order they were added; false beyond
 * the last. */
bool otx_atomic_file_at(
    const otx_atomic_file_set *set, int32_t index, otx_atomic_file_entry *out);

/* Renames the finished files of a shared set and removes the others, as
 * `commit` does of a set of its own. */
otx_status otx_atomic_file_publish(otx_run *run, otx_atomic_file_set *set);

#endif
