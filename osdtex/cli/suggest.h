/* suggest.h -- which of a list of names a mistyped one may have been. */
#ifndef OTX_CLI_SUGGEST_H
#define OTX_CLI_SUGGEST_H

/* The name nearest to `word`, or NULL when none is near.
 *
 *   get  name `index` of the list, NULL behind its end */
const char *otx_suggest_name(
    const char *word, const char *(*get)(const void *list, int index),
    const void *list);

#endif
