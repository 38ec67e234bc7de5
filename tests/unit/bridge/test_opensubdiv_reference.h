/* test_opensubdiv_reference.h -- Far called as its tutorials do, to hold the
 * bridge against. Getters borrow. */
#ifndef OTX_TESTS_OPENSUBDIV_REFERENCE_H
#define OTX_TESTS_OPENSUBDIV_REFERENCE_H

#include "bridge/opensubdiv.h"

#ifdef __cplusplus
extern "C"
{
#endif

    typedef struct reference_osd reference_osd;

    reference_osd *reference_osd_create(
        const otx_osd_mesh *mesh, const float *points, const float *uvs,
        int level);
    void reference_osd_destroy(reference_osd *r);
    int reference_osd_vert_count(const reference_osd *r);
    const float *reference_osd_refined(const reference_osd *r);
    const float *reference_osd_limit(const reference_osd *r);
    const float *reference_osd_tan1(const reference_osd *r);
    int reference_osd_uv_count(const reference_osd *r);
    const float *reference_osd_uvs(const reference_osd *r);
    int reference_osd_face_vert(
        const reference_osd *r, int level, int face, int corner);

#ifdef __cplusplus
}
#endif
#endif
