# tools/keys.awk - which answer of which slot has which key, as C for solver/keys_elsewhere.h: a binary
# holds the keys of its own answers only, but says of a key that it lacks who has it.
#   awk -f tools/keys.awk HEADER ... SLOT=contact contact/*.c SLOT=drag drag/*.c ...
# Headers define lists of keys as macros, NAME_KEYS; sources use them.
function finish(    name) {
    gsub(/\\\n/, " ", text)
    if (file ~ /\.h$/)
        macros()
    else if (file != "" && text ~ /_keys\[\] = \{|\.keys/) {
        name = file
        sub(/.*\//, "", name)
        sub(/\.c$/, "", name)
        keys(text, name)
    }
    text = ""
}
function macros(    part, n, i, name) { # each from its #define to the next line of preprocessor
    n = split(text, part, /\n#/)
    for (i = 1; i <= n; i++)
        if (match(part[i], /^ *define [A-Z]+_KEYS/)) {
            name = substr(part[i], RSTART, RLENGTH)
            sub(/.* /, "", name)
            macro[name] = part[i]
        }
}
function keys(body, answer,    rest, word, m) {
    rest = body
    while (match(rest, /\{[ \n]*"[a-z_]+",[ \n]*"[a-z0-9_]+",[ \n]*KEY_/)) {
        split(substr(rest, RSTART, RLENGTH), word, "\"")
        printf "    {\"%s\", \"%s\", \"%s\", \"%s\"},\n", word[2], word[4], slot, answer
        rest = substr(rest, RSTART + RLENGTH)
    }
    for (m in macro)
        if (body ~ "[^A-Z_]" m "[^A-Z_]" && body !~ "define " m)
            keys(macro[m], answer)
}
FNR == 1 {
    finish()
    file = FILENAME
    slot = SLOT
    if (!begun++)
        print "#include \"solver/keys_elsewhere.h\"\nconst struct elsewhere keys_elsewhere[] = {"
}
{ text = text $0 "\n" }
END {
    finish()
    print "    {0}};"
}
