; Arcs by centre, radius and tangent, rounding and chamfer: quarters of circles of 20
%ARCS G71 *
N10 Q97 = 0 *
N20 T5 G17 S1000 *
N30 G00 G40 G90 X+0 Y+0 Z+10 *
N40 I+0 J+20 *
N50 G03 X+20 Y+20 F300 * ;about 0, 20 from 270 to 0 degrees
N60 D18: SYSREAD Q1 = ID270 NR1 IDX1 *
N70 D18: SYSREAD Q2 = ID270 NR1 IDX2 *
N80 D18: SYSREAD Q3 = ID270 NR1 IDX3 *
N90 Q98 = Q1 - 20 * ;0 + 20
N100 L98,0 *
N110 Q98 = Q2 - 20 * ;the height of the centre
N120 L98,0 *
N130 G02 X+40 Y+40 R+20 * ;the centre is 40, 20
N140 G06 X+60 Y+20 * ;it goes on about 40, 20
N150 I+60 J+0 *
N160 G05 X+80 Y+0 * ;clockwise as the last arc but one
N170 D18: SYSREAD Q1 = ID270 NR1 IDX1 *
N180 D18: SYSREAD Q2 = ID270 NR1 IDX2 *
N190 D18: SYSREAD Q3 = ID270 NR1 IDX3 *
N200 Q98 = Q1 - 80 * ;60 + 20
N210 L98,0 *
N220 Q98 = Q2 - 0 * ;the height of the centre
N230 L98,0 *
N240 G01 X+80 Y-30 *
N250 G25 R5 * ;from 80, -25 to 85, -30
N260 G01 X+120 *
N270 G24 R4 * ;from 116, -30 to 120, -34
N280 G01 Y-60 *
N290 D18: SYSREAD Q1 = ID270 NR1 IDX1 *
N300 D18: SYSREAD Q2 = ID270 NR1 IDX2 *
N310 D18: SYSREAD Q3 = ID270 NR1 IDX3 *
N320 Q98 = Q1 - 120 * ;as written
N330 L98,0 *
N340 Q98 = Q2 + 60 * ;as written
N350 L98,0 *
N360 M30 *
N370 G98 L98 * ;the figure before counts, and is right to a nanometre
N380 Q97 = Q97 + 1 *
N390 Q98 = ABS Q98 *
N400 D11 P01 +Q98 P02 +0.000001 P03 99 *
N410 G98 L0 *
N420 G98 L99 *
N430 D14 P01 +1000 *
N440 G98 L0 *
N99999999 %ARCS G71 *
