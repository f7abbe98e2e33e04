# Read after expect.sh by command_test.sh and drive_command_test.sh: positions and a height map that both name.
printf 'z_mm,note,x_mm,y_mm\n-1,a,3,0\n5,b,0,0\n-1,c,nan,0\n' > in.csv
printf 'render = "height-map"\n[[part]]\nshape = "gaussian"\nheight_mm = 3\nsigma_mm = 5\n' > hill.toml
