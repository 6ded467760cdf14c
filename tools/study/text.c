/* text.c - words for the shell and for tables. */
#include <string.h>
#include "study.h"

char *shell_quoted(const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_-./=+:,%@";
    if (word[0] && strspn(word, plain) == strlen(word))
        return xstrdup(word);
    char *const q = xalloc(4 * strlen(word) + 3, 1), *to = q;
    *to++ = '\'';
    for (const char *c = word; *c; c++) {
        if (*c == '\'') {
            memcpy(to, "'\\''", 4);
            to += 4;
        } else {
            *to++ = *c;
        }
    }
    *to = '\'';
    return q;
}

char *number_text(double x)
{
    return xprintf("%.6g", x);
}

void csv_field(FILE *to, const char *text)
{
    if (!strpbrk(text, ",\"\n")) {
        fputs(text, to);
        return;
    }
    fputc('"', to);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', to);
        fputc(*text == '\n' ? ' ' : *text, to);
    }
    fputc('"', to);
}
