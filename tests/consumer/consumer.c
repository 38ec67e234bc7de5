#include <osdtex/osdtex.h>
#include <stdio.h>

int
main(void)
{
    osdtex_context *context;

    if (osdtex_context_create(NULL, &context) != OSDTEX_OK)
        return 1;
    printf("osdtex %s, %d methods\n", osdtex_version(), osdtex_method_count());
    osdtex_context_destroy(context);
    return 0;
}
