/* fuzz_job.c -- jobs of a farm: refused with a sentence, or every task has a
 * command, a name and words. */
#include "fuzz.h"

#include "farm/farm_job.h"

#include <string.h>

int
LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char error[OTX_FARM_JOB_ERROR_BYTES] = "";
    otx_farm_job job = {0};

    if (!otx_farm_job_read(fuzz_file("job.json", data, size), &job, error))
    {
        fuzz_check(strlen(error) > 3 && strlen(error) < sizeof error);
        return 0;
    }
    fuzz_check(job.task_count > 0 && job.threads >= 0);
    for (int i = 0; i < job.task_count; ++i)
    {
        json_t *words = otx_farm_job_words(&job, i);

        fuzz_check(json_is_array(words));
        fuzz_check(
            otx_farm_job_command(&job, i) && otx_farm_job_task_name(&job, i));
        json_decref(words);
    }
    otx_farm_job_free(&job);
    return 0;
}
