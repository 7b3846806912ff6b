/* The libraries and their kernels: the one list of them, which C, CMake and native/resource.py read.

   A library is a bit. It is compiled with RF_SUBSET set to its name, into a file of that name in lower case
   without RF_. Python calls the first of them, and the last two, whose loops no FMU needs: over films, and over
   the macro steps of a co-simulation, with all kernels but those that step by themselves. Without RF_SUBSET a
   library has all kernels of the list, which names those of its model alone in the sources of an FMU. */
#define RF_ROTORFILM 1
#define RF_ROTORFILM_STATES 2
#define RF_ROTORFILM_SYSTEMS 4
#define RF_ROTORFILM_BUSHES 8
#define RF_ROTORFILM_GRIDS 16
#define RF_ROTORFILM_HEAT 32
#define RF_ROTORFILM_GRID_SYSTEMS 64
#define RF_ROTORFILM_PADS 128
#define RF_ROTORFILM_OIL 512
#define RF_ROTORFILM_LOOPS 256
#define RF_ROTORFILM_MASTER 511

/* RF_KERNEL(name, libraries, picture): rf_<name>_type of kernel_<name>.c, which also has the text for the
   documentation of its FMUs; libraries that have it, of which its FMUs carry the first that has the kernels of
   its parts too; their picture, drawn by tools/draw_icons.py. */
#ifdef RF_KERNEL
RF_KERNEL(ball_bearing, RF_ROTORFILM_STATES, contact)
RF_KERNEL(bush_reaction, RF_ROTORFILM_BUSHES, worn_bush)
RF_KERNEL(bush_wear, RF_ROTORFILM_BUSHES, bush)
RF_KERNEL(conserved_film, RF_ROTORFILM_OIL, grooved_journal)
RF_KERNEL(contact, RF_ROTORFILM_STATES, contact)
RF_KERNEL(damper, RF_ROTORFILM | RF_ROTORFILM_SYSTEMS | RF_ROTORFILM_GRID_SYSTEMS, damper)
RF_KERNEL(five_degree_balls, RF_ROTORFILM_STATES, contact)
RF_KERNEL(grooved_journal, RF_ROTORFILM | RF_ROTORFILM_SYSTEMS | RF_ROTORFILM_GRID_SYSTEMS, grooved_journal)
RF_KERNEL(heated_grooved_journal, RF_ROTORFILM_HEAT, grooved_journal)
RF_KERNEL(heated_journal, RF_ROTORFILM_HEAT, journal)
RF_KERNEL(heavy_tilting_journal, RF_ROTORFILM_PADS, tilting_journal)
RF_KERNEL(journal, RF_ROTORFILM | RF_ROTORFILM_SYSTEMS | RF_ROTORFILM_GRID_SYSTEMS, journal)
RF_KERNEL(linear, RF_ROTORFILM_STATES, linear)
RF_KERNEL(lobed_journal, RF_ROTORFILM_PADS | RF_ROTORFILM_GRID_SYSTEMS, lobed_journal)
RF_KERNEL(oil_damper, RF_ROTORFILM_STATES | RF_ROTORFILM_SYSTEMS | RF_ROTORFILM_GRID_SYSTEMS, damper)
RF_KERNEL(polar_damper, RF_ROTORFILM_STATES | RF_ROTORFILM_SYSTEMS | RF_ROTORFILM_GRID_SYSTEMS, damper)
RF_KERNEL(polar_journal, RF_ROTORFILM_STATES | RF_ROTORFILM_SYSTEMS | RF_ROTORFILM_GRID_SYSTEMS, journal)
RF_KERNEL(pressure_dam, RF_ROTORFILM_GRIDS | RF_ROTORFILM_GRID_SYSTEMS, grooved_journal)
RF_KERNEL(reynolds_journal, RF_ROTORFILM_GRIDS | RF_ROTORFILM_GRID_SYSTEMS, grooved_journal)
RF_KERNEL(rigid_rotor, RF_ROTORFILM_STATES, rotor)
RF_KERNEL(rotor_system, RF_ROTORFILM_SYSTEMS | RF_ROTORFILM_GRID_SYSTEMS, rotor_system)
RF_KERNEL(short_damper, RF_ROTORFILM_STATES | RF_ROTORFILM_SYSTEMS | RF_ROTORFILM_GRID_SYSTEMS, damper)
RF_KERNEL(short_journal, RF_ROTORFILM | RF_ROTORFILM_SYSTEMS | RF_ROTORFILM_GRID_SYSTEMS, short_journal)
RF_KERNEL(tabulated, RF_ROTORFILM_STATES, linear)
RF_KERNEL(thrust, RF_ROTORFILM_GRIDS, thrust)
RF_KERNEL(tilted_journal, RF_ROTORFILM_HEAT, journal)
RF_KERNEL(tilting_journal, RF_ROTORFILM_PADS, tilting_journal)
RF_KERNEL(turbulent_journal, RF_ROTORFILM_GRIDS | RF_ROTORFILM_GRID_SYSTEMS, journal)
#undef RF_KERNEL
#endif
