; Repetitions in subprograms and subprograms in repetitions
%LABELS G71 *
N10 Q97 = 0 *
N20 Q1 = 0 *
N30 Q2 = 0 *
N40 Q3 = 0 *
N50 G98 L1 *
N60 D01 Q1 P01 +Q1 P02 +1 *
N70 L2,0 *
N80 L1,3 * ;4 times
N90 Q98 = Q1 - 4 * ;once and 3 repetitions
N100 L98,0 *
N110 Q98 = Q2 - 20 * ;4 times 5
N120 L98,0 *
N130 G98 L3 *
N140 Q4 = 0 *
N150 G98 L4 *
N160 Q3 = Q3 + 1 *
N170 Q4 = Q4 + 1 *
N180 D12 P01 +Q4 P02 +3 P03 4 * ;until Q4 is 3
N190 L3,1 * ;twice
N200 Q98 = Q3 - 6 * ;2 times 3
N210 L98,0 *
N220 L"TRIPLE",0 *
N230 Q98 = Q5 - 18 * ;3 times 6
N240 L98,0 *
N250 M30 *
N260 G98 L2 *
N270 G98 L5 *
N280 Q2 = Q2 + 1 *
N290 L5,4 * ;5 times
N300 G98 L0 *
N310 G98 L"TRIPLE" *
N320 D03 Q5 P01 +Q3 P02 +3 *
N330 G98 L0 *
N340 M30 *
N350 G98 L98 * ;the figure before counts, and is right to a nanometre
N360 Q97 = Q97 + 1 *
N370 Q98 = ABS Q98 *
N380 D11 P01 +Q98 P02 +0.000001 P03 99 *
N390 G98 L0 *
N400 G98 L99 *
N410 D14 P01 +1000 *
N420 G98 L0 *
N99999999 %LABELS G71 *
