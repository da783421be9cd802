0 BEGIN PGM main MM
1 ; Optimises over the grid of a machine with one rotary axis.
2 TOOL CALL 30 Z
3 L X+0 Y+0 FMAX
4 TCH PROBE 453 KINEMATICS GRID ~
    Q406=+1   ;MODE ~
    Q407=+15  ;SPHERE RADIUS ~
    Q320=+0   ;SET-UP CLEARANCE ~
    Q408=+100 ;RETR. HEIGHT ~
    Q253=+1000 ;F PRE-POSITIONING ~
    Q380=+0   ;REFERENCE ANGLE ~
    Q423=+4   ;NO. OF PROBE POINTS ~
    Q431=+0   ;PRESET
5 END PGM main MM
