/* leftovers.h -- removing files that nobody will finish. */
#ifndef OTX_FILE_LEFTOVERS_H
#define OTX_FILE_LEFTOVERS_H

/* Removes temporaries from the folder of `path` whose processes ran on this
 * machine and are no more. Sets of files that they were giving names to are
 * completed first (file/journal.h). */
void otx_leftovers_sweep(const char *path);

/* Removes those of this process, which is about to end. */
void otx_leftovers_sweep_own(const char *path);

#endif
