/* test_material_files.c -- what files of a material are called. */
#include "file/material_files.h"

#include "folder.h"
#include "support.h"

#include <stdio.h>
#include <string.h>

static void
test_words(void **state)
{
    static const struct
    {
        const char *name;
        otx_material_role role;
    } names[] = {
        {"Rock035_1K-JPG_Color", OTX_MATERIAL_COLOR},
        {"Rock035_1K-JPG_NormalGL", OTX_MATERIAL_NORMAL},
        {"Rock035_1K-JPG_NormalDX", OTX_MATERIAL_NORMAL_DX},
        {"Rock035_1K-JPG_Displacement", OTX_MATERIAL_HEIGHT},
        {"Rock035_1K-JPG_AmbientOcclusion", OTX_MATERIAL_OCCLUSION},
        {"Rock035_1K-JPG", OTX_MATERIAL_ROLE_COUNT},
        {"rock_wall_10_diff_2k", OTX_MATERIAL_COLOR},
        {"rock_wall_10_nor_gl_2k", OTX_MATERIAL_NORMAL},
        {"rock_wall_10_nor_dx_2k", OTX_MATERIAL_NORMAL_DX},
        {"rock_wall_10_arm_2k", OTX_MATERIAL_PACKED},
        {"rock_wall_10_ao_2k", OTX_MATERIAL_OCCLUSION},
        {"GroundDirt004_COL_2K_METALNESS", OTX_MATERIAL_COLOR},
        {"GroundDirt004_METALNESS_2K_METALNESS", OTX_MATERIAL_METALNESS},
        {"GroundDirt004_NRM16_2K", OTX_MATERIAL_NORMAL},
        {"GroundDirt004_GLOSS_2K_SPECULAR", OTX_MATERIAL_GLOSS},
        {"sbmkl3ds_4K_Albedo", OTX_MATERIAL_COLOR},
        {"sbmkl3ds_4K_Metalness", OTX_MATERIAL_METALNESS},
        {"robot arm_Base_Color", OTX_MATERIAL_COLOR},
        {"robot_Normal_OpenGL", OTX_MATERIAL_NORMAL},
        {"robot_Normal.DirectX", OTX_MATERIAL_NORMAL_DX},
        {"robot_Mixed_AO", OTX_MATERIAL_OCCLUSION},
        {"robot_OcclusionRoughnessMetallic", OTX_MATERIAL_PACKED},
        {"robot_Height.1001", OTX_MATERIAL_HEIGHT},
        {"color", OTX_MATERIAL_COLOR},
        {"", OTX_MATERIAL_ROLE_COUNT},
        {"a_b_c_d_e_f_g_h_i_j_k_l_m_n_o_p_q_r_s_t_u_v_w_x_y_z_0a_1a_2a_3a_"
         "4a_5a_6a_7a_8a_rough",
         OTX_MATERIAL_ROUGHNESS},
    };

    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
    {
        int32_t rank;

        if (otx_material_files_role(names[i].name, &rank) != names[i].role)
            fail_msg("%s", names[i].name);
    }
}

static void
touch(const test_folder *folder, const char *name)
{
    FILE *file = fopen(test_path(folder, name), "wb");

    assert_non_null(file);
    fclose(file);
}

/* A file by its end; NULL stays NULL. */
static const char *
base(const char *path)
{
    return path ? strrchr(path, '/') + 1 : "none";
}

static void
test_folders(void **state)
{
    otx_run *run = test_run_create();
    const test_folder folder = test_folder_create();
    const char *all = folder.path;
    otx_material_files files;

    (void)state;
    touch(&folder, "Rock03_Color.png");
    touch(&folder, "Rock03_NormalGL.png");
    touch(&folder, "Rock03_NormalDX.png");
    touch(&folder, "Rock03_notes.txt");
    touch(&folder, "Rock03_preview.png");
    assert_int_equal(otx_material_files_find(run, all, &files), OSDTEX_OK);
    assert_string_equal(
        base(files.paths[OTX_MATERIAL_COLOR]), "Rock03_Color.png");
    assert_string_equal(
        base(files.paths[OTX_MATERIAL_NORMAL_DX]), "Rock03_NormalDX.png");
    assert_string_equal(base(files.paths[OTX_MATERIAL_HEIGHT]), "none");
    /* A second set, and a name that goes on. */
    touch(&folder, "Rock035_Color.png");
    assert_int_equal(
        otx_material_files_find(run, all, &files), OSDTEX_ERROR_FORMAT);
    assert_int_equal(
        otx_material_files_find(run, test_path(&folder, "Rock03"), &files),
        OSDTEX_OK);
    assert_string_equal(
        base(files.paths[OTX_MATERIAL_COLOR]), "Rock03_Color.png");
    assert_int_equal(
        otx_material_files_find(run, test_path(&folder, "Rock03_N"), &files),
        OSDTEX_ERROR_FORMAT);
    assert_int_equal(
        otx_material_files_find(run, test_path(&folder, "x/y"), &files),
        OSDTEX_ERROR_IO);
    test_folder_remove(&folder);
    test_run_destroy(run);
}

int
main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_words),
        cmocka_unit_test(test_folders),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
