# silt: builds what a scene requires. `./run.sh` calls this; by hand:
#   make CONTACT=hertz_mindlin DRAG=ergun POROSITY=divided FLUID=navier_stokes
#   make REAL=float ...   the contact loop in single precision
#   make check      the tests          make verify   all verification cases
#   make bench      timings            make format   clang-format over the tree
SHAPE     ?= sphere
CONTACT   ?= none
ROLLING   ?= none
BOND      ?= none
COHESION  ?= none
LUBRICATION ?= none
DRAG      ?= none
POROSITY  ?= none
FLUID     ?= none
REFERENCE ?= none
STANDARD  := $(shell sed -n 's/^.define FORCES_STANDARD "\(.*\)"$$/\1/p' forces/force.h)
FORCES    ?= $(if $(filter none,$(FLUID)),none,$(subst $(space),+,$(STANDARD)))# sorted: brownian+buoyancy
MODE      ?= release
REAL      ?= double# or float: the precision of the contact loop (solver/real.h)

# A list of forces "a+b" as the answers forces/a forces/b, and a table of them that is made below.
forces_of = $(addprefix forces/,$(filter-out none,$(subst +, ,$(1)))) lists/forces-$(strip $(1))
ANSWERS := shapes/$(SHAPE) contact/$(CONTACT) contact/rolling/$(ROLLING) contact/bond/$(BOND) \
           contact/cohesion/$(COHESION) contact/lubrication/$(LUBRICATION) drag/$(DRAG) \
           porosity/$(POROSITY) solver/fluid/$(FLUID) reference/$(REFERENCE) $(call forces_of,$(FORCES))
SLOT_DIRS := shapes contact contact/rolling contact/bond contact/cohesion contact/lubrication \
             drag porosity solver/fluid reference
NAME  := $(SHAPE)-$(CONTACT)-$(ROLLING)-$(BOND)-$(COHESION)-$(LUBRICATION)-$(DRAG)-$(POROSITY)-$(FLUID)-$(REFERENCE)-$(strip $(FORCES))
BUILD := build/$(MODE)$(if $(filter float,$(REAL)),-float)

# ---- below here nothing needs editing ----
CC := gcc
WARN := -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wdouble-promotion \
        -Wstrict-prototypes -Wmissing-prototypes -Wpointer-arith -Wcast-qual -Wwrite-strings \
        -Wundef -Wvla -Wno-psabi -Wno-unknown-pragmas -Wno-missing-field-initializers
BASE := -std=c11 -D_POSIX_C_SOURCE=200809L -fopenmp -ffp-contract=off -fno-math-errno \
        -fno-trapping-math -fPIC
FLAGS_release := -O3 -march=native -mprefer-vector-width=512 -mtune=icelake-server -g
FLAGS_debug   := -O1 -g3 -fno-omit-frame-pointer -fsanitize=address,undefined \
                 -fno-sanitize-recover=undefined
CFLAGS = $(BASE) $(WARN) $(WERROR) $(FLAGS_$(MODE)) $(FLAGS_$(REAL))
FLAGS_double :=
FLAGS_float := -DSILT_FLOAT -Wno-double-promotion -Wno-conversion -Wno-float-conversion
# In the loop itself constants have the precision of the build too.
ifeq ($(REAL),float)
build/$(MODE)-float/obj/contact/%.o build/$(MODE)-float/obj/shapes/%.o \
$(addprefix build/$(MODE)-float/obj/solver/,contact_block.o contact_laws.o contact_loop.o): \
    FLAGS_float += -fsingle-precision-constant
build/$(MODE)-float/obj/shapes/geometry/%.o: \
    FLAGS_float := -DSILT_FLOAT -Wno-double-promotion -Wno-conversion -Wno-float-conversion
endif
comma := ,
empty :=
space := $(empty) $(empty)
LDFLAGS := -fopenmp $(if $(filter debug,$(MODE)),-fsanitize=address$(comma)undefined) -Wl,--as-needed
LIBS := -lnetcdf -lfftw3 -lgsl -lgslcblas -linih -ludunits2 -lqhull_r -lm

LIB := $(BUILD)/libsilt.a
WALL_KINDS := $(patsubst solver/walls/%.c,%,$(wildcard solver/walls/*.c))
LIB_OBJ := $(patsubst %.c,$(BUILD)/obj/%.o,$(filter-out solver/main.c,$(wildcard solver/*.c)) \
             $(wildcard shapes/geometry/*.c)) \
           $(WALL_KINDS:%=$(BUILD)/obj/solver/walls/%.o) \
           $(BUILD)/obj/lists/walls.o $(BUILD)/obj/lists/keys.o
BIN := $(BUILD)/bin/$(NAME)/silt
STUDY := $(BUILD)/libstudy.a
ALL_ANSWERS := $(foreach d,$(SLOT_DIRS) forces,$(wildcard $(d)/*.c))
SHARED := $(patsubst %.c,$(BUILD)/answers/%.so,$(ALL_ANSWERS))
TOOLS := $(patsubst tools/%.c,$(BUILD)/%,$(wildcard tools/*.c))

.PHONY: matrix silt where tools answers clean format format-check check verify bench deps FORCE
silt: $(BIN)
where: # prints where the binary is
	@echo $(BIN)
tools: $(TOOLS)
answers: $(SHARED)

.PRECIOUS: $(BUILD)/lists/forces-%.c
$(BUILD)/lists/forces-%.c:
	@mkdir -p $(@D)
	@{ echo '#include "forces/force.h"'; \
	   for f in $(filter-out none,$(subst +, ,$*)); do echo "extern const struct force force_$$f;"; done; \
	   echo 'const struct force *const forces[] = {'; \
	   for f in $(filter-out none,$(subst +, ,$*)); do echo "    &force_$$f,"; done; \
	   echo '    0};'; } > $@
# The kinds of walls, all of them.
$(BUILD)/lists/walls.c: FORCE
	@mkdir -p $(@D)
	@{ echo '#include "solver/walls/wall_kind.h"'; \
	   for w in $(WALL_KINDS); do echo "extern const struct wall_kind wall_$$w;"; done; \
	   echo 'const struct wall_kind *const wall_kinds[] = {'; \
	   for w in $(WALL_KINDS); do echo "    &wall_$$w,"; done; \
	   echo '    0};'; } > $@.new
	@cmp -s $@.new $@ && rm $@.new || mv $@.new $@
# Which answer has which key. The name of a slot is that of its folder, but of shapes/ without s; kinds of
# walls likewise.
$(BUILD)/lists/keys.c: FORCE
	@mkdir -p $(@D)
	@awk -f tools/keys.awk $(wildcard solver/*.h contact/*/*.h shapes/geometry/*.h) \
	   $(foreach d,$(SLOT_DIRS) forces,SLOT=$(patsubst shapes,shape,$(notdir $(d))) $(wildcard $(d)/*.c)) \
	   SLOT=wall.kind $(wildcard solver/walls/*.c) > $@.new
	@cmp -s $@.new $@ && rm $@.new || mv $@.new $@
$(BUILD)/obj/lists/%.o: $(BUILD)/lists/%.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) -I. -MMD -MP -c -o $@ $<

$(BUILD)/obj/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) -I$(BUILD) -MMD -MP -c -o $@ $<

$(LIB): $(LIB_OBJ)
	@rm -f $@
	@ar rcs $@ $^

# The library gives a binary only the objects that it refers to: a dry scene takes no FFT.
$(BIN): $(BUILD)/obj/solver/main.o $(patsubst %,$(BUILD)/obj/%.o,$(ANSWERS)) $(LIB)
	@mkdir -p $(@D)
	$(CC) $(LDFLAGS) -o $@ $^ $(LIB) $(LIBS)

$(BUILD)/answers/%.so: $(BUILD)/obj/%.o
	@mkdir -p $(@D)
	$(CC) -shared $(LDFLAGS) -Wl,-Bsymbolic -o $@ $<

# Tools link the first answers of each slot, and show all the library's symbols to others they load.
FIRST := $(patsubst %,$(BUILD)/obj/%.o,shapes/sphere \
         $(addsuffix /none,$(filter-out shapes,$(SLOT_DIRS))) lists/forces-none)
$(BUILD)/%: $(BUILD)/obj/tools/%.o $(FIRST) $(STUDY) $(LIB)
	$(CC) $(LDFLAGS) -rdynamic -o $@ $< $(FIRST) $(STUDY) -Wl,--whole-archive $(LIB) -Wl,--no-whole-archive \
	  $(LIBS) -ldl

# What the tools of studies share.
$(STUDY): $(patsubst %.c,$(BUILD)/obj/%.o,$(wildcard tools/study/*.c))
	@rm -f $@
	@ar rcs $@ $^

# A test holds the whole library and one answer per slot: the first of each folder that its line
# "slots: contact/linear ..." names, or else none; of forces/ the standard ones, where it has a fluid, and
# all that are named. It may load others
# (-Bsymbolic keeps each to its own symbols).
slots_of = $(shell for d in $(SLOT_DIRS); do a=$$d/none; [ $$d = shapes ] && a=$$d/sphere; \
           for s in $$(sed -n 's|^/. slots: \(.*\) ./$$|\1|p' $(1).c); do \
           [ "$${s%/*}" = $$d ] && a=$$s; done; echo $$a; done)
slot_line = $(shell sed -n 's|^/. slots: \(.*\) ./$$|\1|p' $(1).c)
forces_named = $(sort $(patsubst forces/%,%,$(filter forces/%,$(call slot_line,$(1)))) \
               $(if $(filter solver/fluid/%,$(call slot_line,$(1))),$(STANDARD)))
answers_of = $(call slots_of,$(1)) \
             $(call forces_of,$(if $(forces_named),$(subst $(space),+,$(forces_named)),none))
.SECONDEXPANSION:
$(BUILD)/verify/%: $(BUILD)/obj/verify/%.o $(LIB) $(STUDY) $(SHARED) \
                   $$(addprefix $(BUILD)/obj/,$$(addsuffix .o,$$(call answers_of,verify/$$*)))
	@mkdir -p $(@D)
	$(CC) $(LDFLAGS) -rdynamic -o $@ $< $(patsubst %,$(BUILD)/obj/%.o,$(call answers_of,verify/$*)) \
	  $(STUDY) -Wl,--whole-archive $(LIB) -Wl,--no-whole-archive $(LIBS) -ldl

# A bench likewise, without what it does not refer to.
$(BUILD)/bench/%: $(BUILD)/obj/bench/%.o $(LIB) \
                  $$(addprefix $(BUILD)/obj/,$$(addsuffix .o,$$(call answers_of,bench/$$*)))
	@mkdir -p $(@D)
	$(CC) $(LDFLAGS) -o $@ $< $(patsubst %,$(BUILD)/obj/%.o,$(call answers_of,bench/$*)) \
	  $(LIB) $(LIBS)

# These call every answer there is, see verify/answers.h.
$(BUILD)/bench/answers $(BUILD)/bench/contact_answers: $(BUILD)/%: $(BUILD)/obj/%.o $(LIB) $(FIRST) \
                                                       $(SHARED)
	@mkdir -p $(@D)
	$(CC) $(LDFLAGS) -rdynamic -o $@ $< $(FIRST) \
	  -Wl,--whole-archive $(LIB) -Wl,--no-whole-archive $(LIBS) -ldl

# Every combination of the contact slots, linked into a dry binary; kept as empty marks.
names = $(basename $(notdir $(wildcard $(1)/*.c)))
MATRIX := $(foreach a,$(call names,contact),$(foreach b,$(call names,contact/rolling),\
          $(foreach c,$(call names,contact/bond),$(foreach d,$(call names,contact/cohesion),\
          $(foreach e,$(call names,contact/lubrication),$(a)-$(b)-$(c)-$(d)-$(e))))))
QUICK_LINK := $(if $(shell command -v ld.gold),-fuse-ld=gold)# a seventh of the time of GNU ld
matrix: $(patsubst %,$(BUILD)/matrix/%,$(MATRIX))
	@echo "$(words $(MATRIX)) combinations of the contact slots link"
part = $(word $(1),$(subst -, ,$(2)))
matrix_obj = $(BUILD)/obj/shapes/sphere.o $(BUILD)/obj/contact/$(call part,1,$(1)).o \
             $(BUILD)/obj/contact/rolling/$(call part,2,$(1)).o \
             $(BUILD)/obj/contact/bond/$(call part,3,$(1)).o \
             $(BUILD)/obj/contact/cohesion/$(call part,4,$(1)).o \
             $(BUILD)/obj/contact/lubrication/$(call part,5,$(1)).o \
             $(patsubst %,$(BUILD)/obj/%/none.o,drag porosity solver/fluid reference) \
             $(BUILD)/obj/lists/forces-none.o
$(BUILD)/matrix/%: $(BUILD)/obj/solver/main.o $(LIB) $(SHARED) $(FIRST)
	@mkdir -p $(@D)
	@$(CC) $(LDFLAGS) $(QUICK_LINK) -s -o $@.part $< $(call matrix_obj,$*) $(LIB) $(LIBS) && rm $@.part && touch $@

$(BUILD)/provenance.h: FORCE
	@mkdir -p $(@D)
	@{ printf '#define SILT_REVISION "%s"\n' "$$(git describe --always --dirty 2>/dev/null || echo unknown)"; \
	   printf '#define SILT_FLAGS "%s"\n' "$(FLAGS_$(MODE)) $(FLAGS_$(REAL)) $(BASE)"; \
	   printf '#define SILT_COMPILER "%s"\n' "$$($(CC) --version | head -n 1)"; } > $@.new
	@cmp -s $@.new $@ && rm $@.new || mv $@.new $@
$(BUILD)/obj/solver/provenance.o: $(BUILD)/provenance.h

# Debian's packages, where they are missing; see run.sh.
deps:
	@./run.sh install
check: deps
	@verify/check.sh
verify: deps
	@verify/verify.sh
bench: deps
	@bench/bench.sh

format:
	clang-format -i $$(git ls-files '*.c' '*.h')
format-check:
	clang-format --dry-run -Werror $$(git ls-files '*.c' '*.h')
clean:
	rm -rf build

-include $(shell find $(BUILD)/obj -name '*.d' 2>/dev/null)
