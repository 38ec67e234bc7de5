/* report_words.h -- the unit of each figure of a report, and what it says. */
#ifndef OTX_API_REPORT_WORDS_H
#define OTX_API_REPORT_WORDS_H

typedef struct otx_report_words
{
    const char *key;  /* "seams.energy"; one that ends in a dot stands for all
                       * that begin so */
    const char *unit; /* "" of a plain number */
    const char *sentence;
} otx_report_words;

/* NULL for a key that the table does not know. */
const otx_report_words *otx_report_words_of(const char *key);

#endif
