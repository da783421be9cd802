0 BEGIN PGM 8025 MM
1 ; Raises the feed in steps along a ramp.
2 ; A value that stands in its parameter before the start is kept.
3 FN 9: IF Q1 IS DEFINED GOTO LBL 11
4 Q1 = +100 ;Feed at the start
5 LBL 11
6 FN 9: IF Q2 IS DEFINED GOTO LBL 12
7 Q2 = +500 ;Feed at the end
8 LBL 12
9 FN 9: IF Q3 IS DEFINED GOTO LBL 13
10 Q3 = +40 ;Length of the ramp, incremental
11 LBL 13
12 FN 9: IF Q4 IS DEFINED GOTO LBL 14
13 Q4 = +8 ;Number of steps
14 LBL 14
15 FN 9: IF Q5 IS DEFINED GOTO LBL 15
16 Q5 = +10 ;Start in X
17 LBL 15
18 * - Increments
19 Q6 = ( Q2 - Q1 ) / Q4 ;of the feed
20 Q7 = Q3 / Q4 ;of the path
21 Q24 = 0 ;Steps done
22 TOOL CALL 5 Z S3000
23 L X+Q5 Y+0 R0 FMAX M3
24 L Z+2 R0 FMAX
25 L Z-1 R0 FQ1
26 * - Ramp
27 LBL 1
28 Q24 = Q24 + 1
29 Q8 = Q1 + Q24 * Q6
30 L IX+Q7 R0 FQ8
31 FN 12: IF +Q24 LT +Q4 GOTO LBL 1
32 * - On at the full feed
33 L IY+20 R0 FQ2
34 L Z+50 R0 FMAX M5
35 END PGM 8025 MM
