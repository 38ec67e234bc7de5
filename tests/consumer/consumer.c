/* Textures a cage with a picture:  consumer CAGE.obj PICTURE OUT.obj */
#include <osdtex/osdtex.h>
#include <stdio.h>

int
main(int argc, char **argv)
{
    osdtex_context *context = NULL;
    osdtex_cage *cage = NULL;
    osdtex_exemplar *exemplar = NULL;
    osdtex_mapping *mapping = NULL;
    osdtex_status status;

    if (argc != 4 || osdtex_context_create(NULL, &context) != OSDTEX_OK)
        return 1;
    status = osdtex_cage_read(context, argv[1], NULL, &cage);
    if (status == OSDTEX_OK)
        status = osdtex_exemplar_read(context, argv[2], NULL, &exemplar);
    if (status == OSDTEX_OK)
        status = osdtex_map(context, cage, exemplar, NULL, &mapping);
    if (status == OSDTEX_OK)
        status = osdtex_mapping_write(context, mapping, argv[3], NULL);
    if (status != OSDTEX_OK)
        fprintf(stderr, "%s\n", osdtex_context_error(context)->message);
    osdtex_mapping_destroy(mapping);
    osdtex_exemplar_destroy(exemplar);
    osdtex_cage_destroy(cage);
    osdtex_context_destroy(context);
    return status == OSDTEX_OK ? 0 : 1;
}
