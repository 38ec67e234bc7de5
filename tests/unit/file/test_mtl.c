/* test_mtl.c -- material libraries as they are found, and as we write them. */
#include "support.h"

#include "file/mtl.h"

#include <stdlib.h>
#include <unistd.h>

static otx_mtl
parse(otx_run *run, const char *text)
{
    otx_mtl mtl;

    assert_int_equal(
        otx_mtl_parse(run, "t.mtl", text, strlen(text), &mtl), OSDTEX_OK);
    return mtl;
}

static void
what_pictures_need_is_read(void **state)
{
    const otx_mtl mtl = parse(
        *state, "# lib\nnewmtl  red paint \nNs 10\nKa 0 0 0\nKd 1 .5 0\n"
                "map_Kd my tex.exr\nmap_Bump x.png\nnewmtl b\n\tKd .25\n"
                "newmtl c\nKd xyz 1 2 3\nillum 2\nmap_Kd\n"
                "map_Pr -imfchan g r.png\nmap_Pm m.png\nnorm n.png\n"
                "disp h.exr\n");

    assert_int_equal(mtl.count, 3);
    assert_string_equal(mtl.materials[0].name, "red paint");
    assert_true(mtl.materials[0].diffuse[1] == .5f);
    assert_string_equal(mtl.materials[0].map_kd, "my tex.exr");
    assert_int_equal(mtl.materials[0].line, 2);
    assert_true(mtl.materials[1].diffuse[2] == .25f);
    assert_null(mtl.materials[1].map_kd);
    assert_true(mtl.materials[2].diffuse[0] == 1);
    assert_null(mtl.materials[2].map_kd);
    assert_string_equal(mtl.materials[2].maps.roughness, "r.png");
    assert_string_equal(mtl.materials[2].maps.metalness, "m.png");
    assert_string_equal(mtl.materials[2].maps.normal, "n.png");
    assert_string_equal(mtl.materials[2].maps.height, "h.exr");
    assert_null(mtl.materials[0].maps.normal);
}

static void
map_options_are_skipped(void **state)
{
    static const struct
    {
        const char *line, *name;
    } cases[] = {
        {"-s 1 1 1 a b.png", "a b.png"},
        {"-s 2 a.png", "a.png"},
        {"-o .5 .5 1001.exr", "1001.exr"},
        {"-clamp on -blendu off -mm 0 1 -bm .5 -imfchan r x.tif", "x.tif"},
        {"-colorspace ACEScg x.exr", "x.exr"},
        {"-texres 512 -type sphere -boost 2 -cc on -t 1 -blendv on x", "x"},
        {"-unknown.png", "-unknown.png"},
        {"tex\\a.png", "tex\\a.png"}};

    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    {
        char text[256];
        otx_mtl mtl;

        snprintf(text, sizeof text, "newmtl a\nmap_Kd %s\n", cases[i].line);
        mtl = parse(*state, text);
        assert_string_equal(mtl.materials[0].map_kd, cases[i].name);
    }
}

static void
errors_name_the_line(void **state)
{
    static const struct
    {
        const char *text, *words;
    } cases[] = {
        {"\nKd 1 1 1\n", "begin with 'newmtl'"},
        {"newmtl a\nKd x\n", "'x' is not a number"},
        {"newmtl a\nKd 1 2\n", "blue should be"},
        {"newmtl a\nKd 1 nan 2\n", "not a finite"}};
    otx_run *run = *state;

    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
    {
        osdtex_diagnostic d;
        otx_mtl mtl;

        assert_int_equal(
            otx_mtl_parse(
                run, "t.mtl", cases[i].text, strlen(cases[i].text), &mtl),
            OSDTEX_ERROR_FORMAT);
        otx_diagnostics_get(
            run->diagnostics, otx_diagnostics_count(run->diagnostics) - 1, &d);
        assert_int_equal(d.line, 2);
        assert_non_null(strstr(d.message, cases[i].words));
    }
}

static void
materials_are_found_by_either_name(void **state)
{
    const otx_mtl mtl =
        parse(*state, "newmtl a b\nnewmtl c\nnewmtl a_b\nnewmtl c\n");

    assert_int_equal(otx_mtl_find(&mtl, "a b"), 0);
    assert_int_equal(otx_mtl_find(&mtl, "a_b"), 2);
    assert_int_equal(otx_mtl_find(&mtl, "c"), 3);
    assert_int_equal(otx_mtl_find(&mtl, "a"), -1);
    assert_int_equal(otx_mtl_find(&mtl, ""), -1);
    assert_int_equal(otx_mtl_find(&mtl, "c d"), -1);
}

static void
written_text_is_plain(void **state)
{
    static const otx_mtl_material materials[] = {
        {.name = "my mat", .diffuse = {1, 1, 1}, .map_kd = "x.exr"},
        {.name = "b", .diffuse = {.5f, 0, 1}}};
    static const otx_mtl mtl = {"t.mtl", 2, materials};
    otx_run *run = *state;
    char path[] = "/tmp/osdtex-mtl-XXXXXX";
    const int fd = mkstemp(path);
    char text[256];
    FILE *file;

    assert_true(fd >= 0);
    close(fd);
    assert_int_equal(otx_mtl_write(run, &mtl, path, NULL), OSDTEX_OK);
    file = fopen(path, "r");
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    fclose(file);
    unlink(path);
    assert_string_equal(
        text, "newmtl my_mat\nKd 1 1 1\nillum 1\nmap_Kd x.exr\n"
              "newmtl b\nKd 0.5 0 1\nillum 1\n");
}

int
main(void)
{
#define TEST(name)                                                             \
    cmocka_unit_test_setup_teardown(name, test_run_setup, test_run_teardown)
    const struct CMUnitTest tests[] = {
        TEST(what_pictures_need_is_read), TEST(map_options_are_skipped),
        TEST(errors_name_the_line), TEST(materials_are_found_by_either_name),
        TEST(written_text_is_plain)};

    return cmocka_run_group_tests(tests, NULL, NULL);
}
