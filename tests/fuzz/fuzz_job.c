/* fuzz_job.c -- jobs of a farm: refused with a sentence, or every task has a
 * command, a name and words. */
#include "fuzz.h"

#include "farm/job.h"

#include <string.h>

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char error[OTX_JOB_ERROR_BYTES] = "";
    otx_job job = {0};

    if (!otx_job_read(fuzz_file("job.json", data, size), &job, error))
    {
        fuzz_check(strlen(error) > 3 && strlen(error) < sizeof error);
        return 0;
    }
    fuzz_check(job.task_count > 0 && job.threads >= 0);
    for (int i = 0; i < job.task_count; ++i)
    {
        json_t *words = otx_job_words(&job, i);

        fuzz_check(json_is_array(words));
        fuzz_check(otx_job_command(&job, i) && otx_job_task_name(&job, i));
        json_decref(words);
    }
    otx_job_free(&job);
    return 0;
}
